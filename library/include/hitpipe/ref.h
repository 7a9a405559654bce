/* hitpipe's ray-box units in software: the operands of my ray and my box, the HIT that the unit must give,
 * and the answer of exact arithmetic. C99; <hitpipe/ref.hpp> is the same for C++20. docs/library.md has
 * examples.
 *
 * Numbers: rays and boxes are binary32, in the cube [-1, 1]^3. Nothing is clamped or flushed: what is outside
 *   is refused. hitpipe_fit() and hitpipe_to_cube_...() take a scene of any size there.
 * Arithmetic: answers do not depend on the caller's floating-point environment, neither on its rounding nor on whether
 *   it flushes denormal numbers. Each call computes in the default one and leaves the caller's, with its flags.
 * Errors: a function that returns a status writes nothing but the error when it fails. hitpipe_error() is
 * then one line that says what is wrong and what is allowed. Ownership: the library owns every string and
 * every pointer that it gives. Only hitpipe_close() frees. Threads: two threads must not use one unit at a
 * time. Everything else may be called from any thread. */
#ifndef HITPIPE_REF_H
#define HITPIPE_REF_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__) || defined(__clang__)
#define HITPIPE_API __attribute__((visibility("default")))
#else
#define HITPIPE_API
#endif

typedef enum hitpipe_status {
  HITPIPE_OK = 0,
  HITPIPE_BAD_ARGUMENT = 1, /* a null pointer, an index or a number of boxes that is not allowed */
  HITPIPE_BAD_DESIGN = 2,   /* there is no design of that name */
  HITPIPE_BAD_FORMAT = 3,   /* the design has no such format */
  HITPIPE_BAD_RAY = 4,      /* outside the cube, no direction, NaN, a negative length */
  HITPIPE_BAD_BOX = 5,      /* outside the cube, inverted, NaN */
  HITPIPE_NO_RAY = 6,       /* hitpipe_set_ray() comes first */
  HITPIPE_FAILED = 7,       /* out of memory, or an error of hitpipe itself */
  HITPIPE_BAD_OPERAND = 8,  /* does not fit its port */
  HITPIPE_BAD_LIBRARY = 9,  /* there is no such component library, or it lacks what the design is made of */
  HITPIPE_BAD_MESH = 10,    /* a corner that is not allowed, or a triangle of corners that are not there */
  HITPIPE_BAD_HIERARCHY = 11, /* of nodes or an order that are none */
  HITPIPE_NOT_CLOSED = 12,  /* only a closed mesh has an inside */
  HITPIPE_STOPPED = 13,     /* the thread's hitpipe_watch ended the call */
  HITPIPE_BAD_INSTANCE = 14 /* of a mesh that is not there, or with a matrix that the world cannot hold */
} hitpipe_status;

/* Why the last call of this thread that failed did so: one line, "" if none did. Valid until the next failure
 * in this thread. */
HITPIPE_API const char* hitpipe_error(void);

/* For example "0.2.0"; the second number changes when this interface does. */
HITPIPE_API const char* hitpipe_version(void);

/* Ends a long call before its time. */
typedef struct hitpipe_watch {
  int (*stop)(void* context); /* not NULL; what is not 0 ends the call */
  void* context;
} hitpipe_watch;

/* From now on long calls of this thread ask `stop` some times a second, in this thread. A call that it ends returns
 * HITPIPE_STOPPED; only then may a part of the answers be written. `stop` may call the library, but not with the unit
 * of the call. NULL: nobody is asked. The watch lives until another is set. Returns the one before. */
HITPIPE_API const hitpipe_watch* hitpipe_set_watch(const hitpipe_watch* watch);

/* ---- Rays and boxes ---- */

/* The points origin + t * direction, 0 <= t <= length. */
typedef struct hitpipe_ray {
  float origin[3];    /* each in [-1, 1] */
  float direction[3]; /* finite and not all zero; need not have unit length */
  float length;       /* in units of direction; >= 0, or INFINITY */
} hitpipe_ray;

/* The closed set min <= p <= max. */
typedef struct hitpipe_box {
  float min[3]; /* -1 <= min <= max on each axis */
  float max[3]; /* max <= 1 */
} hitpipe_box;

/* met[i] = 1 if the ray and box i have a point in common, touching included, else 0. Exact arithmetic on the
 * binary32 values as given. */
HITPIPE_API hitpipe_status hitpipe_exact(const hitpipe_ray* ray, const hitpipe_box* boxes, size_t box_count,
                                         uint8_t* met);

/* The same for each ray and a box of its own: met[i] is of ray i and box i. All rays, then all boxes, are
 * checked before anything is written; an error names the first bad one by its index. */
HITPIPE_API hitpipe_status hitpipe_exact_pairs(const hitpipe_ray* rays, const hitpipe_box* boxes,
                                               size_t pair_count, uint8_t* met);

/* ---- Designs ---- */

typedef struct hitpipe_design_info {
  const char* name;           /* "int_slabs" */
  const char* summary;        /* one line */
  const char* default_format; /* "20/24" */
  const char* formats;        /* which there are: "n/t with n in 6..32 and t in 6..2n-1" */
  int conservative;           /* 1: HIT whenever the exact ray meets the box */
  int boxes_per_test;         /* 1 or 2 */
} hitpipe_design_info;

HITPIPE_API size_t hitpipe_design_count(void);
/* index < hitpipe_design_count() */
HITPIPE_API hitpipe_status hitpipe_design(size_t index, hitpipe_design_info* out);

/* Whether the design has this format, which is spelled as for hitpipe_open(). */
HITPIPE_API hitpipe_status hitpipe_check_format(const char* design, const char* format);

/* What `hitpipe area` says of a design at a format: without pruning, with stall flow control, one test a
 * cycle. A library of cells has areas, and a library of a chip has what is taken of the chip. */
typedef struct hitpipe_price_info {
  int stages;         /* cycles from operands to results */
  int stage_delay_ps; /* of the slowest stage */
  int is_chip;        /* 1: area_um2 is 0; 0: the three numbers behind it are 0 */
  int64_t area_um2;   /* of the whole unit, for all boxes of a test */
  int64_t lookup_tables;
  int64_t registers;
  int64_t multiplier_blocks;
} hitpipe_price_info;

/* `library` is a component library as `hitpipe area --library` takes it: the name of a built-in one or a file
 * NAME.json. NULL or "" is "thesis_250nm", Table 7.1 of the thesis. */
HITPIPE_API hitpipe_status hitpipe_price(const char* design, const char* format, const char* library,
                                         hitpipe_price_info* out);

/* ---- A unit: a design at a format ---- */

typedef struct hitpipe_unit hitpipe_unit;

/* What an operand tells the unit. */
typedef enum hitpipe_role {
  HITPIPE_ORIGIN,       /* of the ray */
  HITPIPE_ORIGIN_HIGH,  /* upper bound of the origin, where HITPIPE_ORIGIN is a lower one */
  HITPIPE_ENDPOINT,     /* of the ray */
  HITPIPE_DIRECTION,    /* of the ray */
  HITPIPE_INVERSE,      /* reciprocal of a direction component */
  HITPIPE_INVERSE_LOW,  /* lower bound of a reciprocal */
  HITPIPE_INVERSE_HIGH, /* upper bound of a reciprocal */
  HITPIPE_LENGTH,       /* of the ray */
  HITPIPE_ENDLESS,      /* 1: the ray has no end, so length or endpoint is ignored */
  HITPIPE_PLANE_LOW,    /* lower plane of a box */
  HITPIPE_PLANE_HIGH,   /* upper plane of a box */
  HITPIPE_EXPONENT,     /* power of two that belongs to bounds of a reciprocal */
  HITPIPE_BACKWARD,     /* 1: the ray's direction is negative */
  HITPIPE_ENTRY,        /* distance at which the ray enters a parent box */
  HITPIPE_OWNER,        /* which of two boxes has a plane */
  HITPIPE_MAJOR,        /* 1: the direction is largest along this axis */
  HITPIPE_OTHER,
  HITPIPE_CORNER /* of a triangle; `box` is its number */
} hitpipe_role;

/* How an operand's bits are read. */
typedef enum hitpipe_kind {
  HITPIPE_INTEGER, /* two's complement */
  HITPIPE_NATURAL, /* unsigned */
  HITPIPE_REAL,    /* the pattern of a float */
  HITPIPE_FLAG     /* one bit */
} hitpipe_kind;

/* What a result tells the traversal. */
typedef enum hitpipe_meaning {
  HITPIPE_HIT,         /* 1: the ray meets the box */
  HITPIPE_ENTERS,      /* distance at which the ray enters the box */
  HITPIPE_LEAVES,      /* distance at which the ray leaves the box */
  HITPIPE_SECOND_FIRST, /* 1: the second box comes first */
  /* Of a triangle test: numbers in two halves. */
  HITPIPE_DETERMINANT,
  HITPIPE_DETERMINANT_LOW,
  HITPIPE_VOLUME,
  HITPIPE_VOLUME_LOW,
  HITPIPE_EDGE_U,
  HITPIPE_EDGE_U_LOW,
  HITPIPE_EDGE_V,
  HITPIPE_EDGE_V_LOW,
  /* Of an integer ray. */
  HITPIPE_ERROR,          /* 1: there is no such ray */
  HITPIPE_MAJOR_AXIS,     /* 1: the direction is largest along this axis */
  HITPIPE_BACK,           /* 1: the direction is negative along this ray axis */
  HITPIPE_RAY_ORIGIN,     /* of the ray */
  HITPIPE_SLOPE,          /* magnitude of the direction, divided by its largest component */
  HITPIPE_MANTISSA_LOW,   /* bounds of a slope's reciprocal */
  HITPIPE_MANTISSA_HIGH,
  HITPIPE_RAY_EXPONENT,   /* power of two that belongs to both bounds */
  HITPIPE_RAY_LENGTH,     /* of the ray */
  /* Of a hit of a triangle. */
  HITPIPE_TIE,            /* 1: at an edge or a corner */
  HITPIPE_ONCE,           /* 1: it counts as a crossing */
  HITPIPE_SIDE,           /* 1: the determinant is negative */
  HITPIPE_ZERO,           /* bits of u, v, e0; 1: it is 0 */
  HITPIPE_INNER           /* likewise; 1: its sign is that of the inside */
} hitpipe_meaning;

typedef struct hitpipe_port_info {
  const char* name;  /* as the Verilog port's */
  int width;         /* bits, 1..64 */
  int is_signed;     /* 1: two's complement */
  hitpipe_kind kind; /* a float is the unsigned number with its bits */
  hitpipe_role role;
  int axis;         /* 0, 1, 2 for x, y, z; -1: none */
  int box;          /* for planes: of which box, 0 or 1 */
  int64_t min, max; /* the set-up gives numbers from min to max */
} hitpipe_port_info;

typedef struct hitpipe_result_info {
  const char* name; /* as the Verilog port's */
  int width;        /* bits, 1..64 */
  int is_signed;    /* 1: two's complement */
  hitpipe_meaning meaning;
  int box; /* for which box it answers, 0 or 1 */
} hitpipe_result_info;

/* `format` is spelled as for `hitpipe rtl --bits`: "20/24"; NULL or "" is the default. On success *out is a
 * unit that hitpipe_close() must free; otherwise *out does not change. */
HITPIPE_API hitpipe_status hitpipe_open(const char* design, const char* format, hitpipe_unit** out);
/* NULL is allowed. */
HITPIPE_API void hitpipe_close(hitpipe_unit* unit);

/* What the unit is. The strings live as long as it does. Of NULL the answer is "" or 0, here and where ports
 * and results are counted, and hitpipe_error() says so. */
HITPIPE_API const char* hitpipe_unit_design(const hitpipe_unit* unit);
HITPIPE_API const char* hitpipe_unit_format(const hitpipe_unit* unit);
HITPIPE_API int hitpipe_unit_conservative(const hitpipe_unit* unit);
HITPIPE_API size_t hitpipe_unit_boxes_per_test(const hitpipe_unit* unit);

/* Operand and result ports, in the order of the Verilog, the manifest and the vector file. */
HITPIPE_API size_t hitpipe_port_count(const hitpipe_unit* unit);
HITPIPE_API hitpipe_status hitpipe_port(const hitpipe_unit* unit, size_t index, hitpipe_port_info* out);
HITPIPE_API size_t hitpipe_result_count(const hitpipe_unit* unit);
HITPIPE_API hitpipe_status hitpipe_result(const hitpipe_unit* unit, size_t index, hitpipe_result_info* out);

/* ---- Tests ---- */

/* Sets up the ray of all tests that follow. If it is refused, the unit has no ray. */
HITPIPE_API hitpipe_status hitpipe_set_ray(hitpipe_unit* unit, const hitpipe_ray* ray);

/* What hitpipe_test() and hitpipe_test_pairs() write. Each may be NULL. T is the number of tests: box_count / boxes per
 * test. */
typedef struct hitpipe_answers {
  uint8_t* hit;      /* box_count: HIT of the unit's C++ datapath, equal to the Verilog's */
  uint8_t* exact;    /* box_count: as hitpipe_exact() */
  int64_t* operands; /* T * port count: each test's operands, in port order */
  int64_t* results;  /* T * result count: what the unit answers, in the order of the results */
} hitpipe_answers;

/* Tests the ray against boxes. All boxes are checked before anything is written; an error names the first bad
 * one by its index. A unit with two boxes a test takes boxes 2i and 2i + 1 as the two children of a parent,
 * so box_count must be even. It gets the parent, their union, tested first, as at the root of a hierarchy. If
 * the ray misses it, both hits are 0, and operands and results belong to that first test. */
HITPIPE_API hitpipe_status hitpipe_test(hitpipe_unit* unit, const hitpipe_box* boxes, size_t box_count,
                                        const hitpipe_answers* out);

/* Tests each ray against a box of its own: test i takes ray i and box i, or, where a test has two boxes, ray i
 * and boxes 2i and 2i + 1. So there are test_count rays and test_count * boxes per test boxes, and box_count
 * of hitpipe_answers is the number of boxes. The answers are those of hitpipe_set_ray() and hitpipe_test(),
 * one test after the other. All rays, then all boxes, are checked before anything is written; an error names
 * the first bad one by its index. The unit has no ray after the call; a call that fails leaves the ray that
 * was set. */
HITPIPE_API hitpipe_status hitpipe_test_pairs(hitpipe_unit* unit, const hitpipe_ray* rays,
                                              const hitpipe_box* boxes, size_t test_count,
                                              const hitpipe_answers* out);

/* What the unit answers to operands of your own, whatever set-up they come from: bit for bit the results of
 * the Verilog. Each test has all operands in port order: test_count * port count numbers. `results` gets
 * test_count * result count. A signed operand of width w is from -2^(w-1) to 2^(w-1) - 1, another from 0 to
 * 2^w - 1; a float is the number with its bits. min and max of its port, which your set-up may leave, do not
 * count. All operands are checked before anything is written. No ray needs to be set. Nobody judges the
 * answer: there is no ray and no box. */
HITPIPE_API hitpipe_status hitpipe_test_operands(const hitpipe_unit* unit, const int64_t* operands, size_t test_count,
                                       int64_t* results);

/* The bits of an operand or result of this width, as a port or $readmemh takes it: two's complement cut to
 * the width. */
HITPIPE_API uint64_t hitpipe_bits(int64_t value, int width);

/* ---- From a scene's own units into the cube ---- */

/* A point in the scene's units. */
typedef struct hitpipe_bounds {
  double min[3];
  double max[3];
} hitpipe_bounds;

/* cube = (own - offset) * scale, the same scale for all axes. */
typedef struct hitpipe_transform {
  double offset[3];
  double scale; /* > 0 */
} hitpipe_transform;

/* The transform that takes the bounds into the cube: their centre to 0, their longest side to +-(1 - 2^-10).
 * The margin leaves room for padded boxes and computed points. Bounds are finite with some extent. */
HITPIPE_API hitpipe_status hitpipe_fit(const hitpipe_bounds* bounds, hitpipe_transform* out);

/* The least binary32 box that holds the box, moved by the transform; in rare doubt a coordinate is one
 * binary32 farther out. So a ray that meets the moved box meets what is written. NULL does not move it. Fails
 * if it is not in the cube then. */
HITPIPE_API hitpipe_status hitpipe_to_cube_box(const hitpipe_transform* transform, const hitpipe_bounds* box,
                                               hitpipe_box* out);

/* Numbers are rounded to nearest. The direction stays as it is, so the length is scaled. The ray is then the
 * rounded one: everything judges that. NULL does not move it. */
HITPIPE_API hitpipe_status hitpipe_to_cube_ray(const hitpipe_transform* transform, const double origin[3],
                                               const double direction[3], double length, hitpipe_ray* out);

#ifdef __cplusplus
}
#endif
#endif
