  // Rays may want a count.
`define COUNTS
