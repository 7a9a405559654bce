  // A ray may want its last triangle again.
`define QUESTIONS
