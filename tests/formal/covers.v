// A cover as an assertion that it never happens: what breaks it is a run to it.
(* techmap_celltype = "$cover" *)
module cover_is_never (A, EN);
  input A, EN;
  \$assert _TECHMAP_REPLACE_ (.A(~A), .EN(EN));
endmodule
