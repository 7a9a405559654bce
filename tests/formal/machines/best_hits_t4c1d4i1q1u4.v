  // Rays may want crossings.
`define QUESTIONS
