// The words that may begin a line of an OBJ file, in Wavefront's specification and beside it.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace hitpipe::ref {

/// Lines that add or move no triangle.
inline constexpr std::array<std::string_view, 28> obj_skipped{
    // texture coordinates, normals, smoothing; points and lines, which no ray hits
    "vt", "vn", "s", "p", "l",
    // how elements are shown; maps; files for shadows and reflections
    "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech", "maplib", "usemap",
    // parameters of free-form curves and surfaces: nothing without those
    "vp", "cstype", "deg", "bmat", "step", "parm", "end", "mg", "res",
    // beside the specification: weights of bones (tinyobjloader), tags of subdivision (OpenSubdiv, whose cage
    // is read), colours of vertices, tangents
    "vw", "t", "vc", "tn"};

/// Lines that add geometry which is not read, or that start something.
inline constexpr std::array<std::string_view, 14> obj_refused{
    "curv", "curv2", "surf", "trim", "hole", "scrv", "sp", "con",  // free-form
    "bsp",  "bzp",   "cdc",  "cdp",                                // the same in version 2.11
    "call", "csh"};

template <std::size_t n>
[[nodiscard]] constexpr bool is_among(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace hitpipe::ref
