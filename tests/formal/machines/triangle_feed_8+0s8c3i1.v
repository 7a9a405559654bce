  // It may settle ties.
`define QUESTIONS
