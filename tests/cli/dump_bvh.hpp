// The program of docs/scenes.md that writes a hierarchy of one's own. The test compares this text with the
// page.
#pragma once

#include <cstdio>
#include <vector>

struct Node {
  float min[3], max[3];
  int child[2];      // of a branch
  int first, count;  // of a leaf: its part of the list of triangles; count is 0 in a branch
};

inline void dump(std::FILE* out, const std::vector<Node>& nodes, const std::vector<int>& triangles) {
  std::fprintf(out, "hitpipe-bvh 1\nspace scene\nnodes %zu\n", nodes.size());
  for (const Node& n : nodes) {
    std::fprintf(out, "%s %.9g %.9g %.9g %.9g %.9g %.9g", n.count > 0 ? "leaf" : "branch",  //
                 n.min[0], n.min[1], n.min[2], n.max[0], n.max[1], n.max[2]);
    if (n.count > 0) {
      std::fprintf(out, " %d %d\n", n.first, n.count);
    } else {
      std::fprintf(out, " %d %d\n", n.child[0], n.child[1]);
    }
  }
  std::fprintf(out, "triangles %zu\n", triangles.size());
  for (const int t : triangles) std::fprintf(out, "%d\n", t);
}
