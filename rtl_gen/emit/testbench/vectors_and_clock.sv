  // Unlike $readmemh, this sees every damage of the file, and sees the same in every simulator.
  task read_vectors;
    integer file, length, line, found;
    reg in_comment;
    reg [8*(DIGIT_COUNT+1)-1:0] text;
    reg [8*DIGIT_COUNT-1:0] digits;
    reg [BITS-1:0] vector;
    begin
      file = $fopen("MODULE_vectors.hex", "r");
      if (file == 0) begin
        $display("FAIL MODULE_vectors.hex: cannot be opened");
        $fatal(1);
      end
      line = 1; found = 0; in_comment = 1'b0;
      length = $fgets(text, file);
      while (length != 0) begin
        if (text[8*(length-1) +: 8] == "/") in_comment = 1'b1;
        if (!in_comment && length > 1) begin
          // A good line is the one that %h writes for its number.
          if ($sscanf(text, "%h", vector) != 1) vector = {BITS{1'b0}};
          $sformat(digits, "%h", vector);
          if (text != {digits, 8'h0a} || ^vector === 1'bx) begin
            $display("FAIL MODULE_vectors.hex, line %0d: not %0d lower-case hexadecimal digits of %0d bits",
                     line, DIGIT_COUNT, BITS);
            $fatal(1);
          end
          if (found < COUNT) vectors[found] = vector;
          found = found + 1;
        end
        if (text[7:0] == 8'h0a) begin
          in_comment = 1'b0;
          line = line + 1;
        end
        length = $fgets(text, file);
      end
      $fclose(file);
      if (found != COUNT) begin
        $display("FAIL MODULE_vectors.hex: %0d vectors, expected %0d", found, COUNT);
        $fatal(1);
      end
    end
  endtask

  initial begin
    clk = 1'b0;
    forever #5 clk = ~clk;
  end
