# The whole project in a few words. `make demo` and `make test` are all that a newcomer types.
# Groups of packages.txt that a goal needs beside the group build; a goal without a line here needs all.
groups_demo := simulate
groups_bench := simulate
groups_prove := simulate chips
groups_lint := simulate check
groups_alone := simulate check
GROUPS := build $(foreach goal,$(filter-out build,$(MAKECMDGOALS)),$(or $(groups_$(goal)),simulate chips check))
JOBS ?= $(shell nproc)
# Tests that `make sanitize` runs, as `ctest -R` selects them.
SANITIZED ?= .
# What has threads: pieces of work side by side, signals, processes, walks, hierarchies, renders.
THREADED := ^host/|rays/(trace|tree)/|sw_ref/(trace|hierarchy)/|(render|whitted|int_tracer)_test
# TEST_PATH=FOLDER: tests find programs in that folder only.
# Runs tests of CTest. Those of tests/slow_tests.txt are the second part of `make test`.
RUN_TESTS = $(if $(TEST_PATH),PATH="$(TEST_PATH)") ctest --preset release -j $(JOBS) -LE long
SLOW = "^($$(paste -sd'|' tests/slow_tests.txt))$$"
CXX_FILES := $$(git ls-files '*.hpp' '*.cpp')

.PHONY: demo check test test-long test-designs build lint format bench sanitize threads fuzz mutants coverage prove prove-all-widths netlists hls-check alone fresh dist deb packages clean help

help:
	@echo 'make demo      Spheres through the 20/24 Verilog: image, Verilog, schematics in out/demo'
	@echo 'make check     the tests that take a few seconds at most; the others are in tests/slow_tests.txt'
	@echo 'make test      all tests but the long ones: those of make check, then the slow ones'
	@echo 'make test-long  adds two designs in a copy of the tree; 10^6 exact triangle tests; each pair of features; proofs'
	@echo 'make test-designs  all tests in a copy of the tree with two designs more'
	@echo 'make build     the program, build/hitpipe, the library hitpipe::ref and the Python module, with a quarter of the packages'
	@echo 'make bench     benchmarks'
	@echo 'make lint      formatting and clang-tidy of what changed; make format mends the first'
	@echo 'make sanitize  all tests under ASan and UBSan'
	@echo 'make threads   tests of what runs in several threads, under ThreadSanitizer'
	@echo 'make fuzz      libFuzzer, SECONDS=60 in all: loaders, command line, what is printed'
	@echo 'make mutants   3,500 faults in the Verilog of cores and units; MUTANTS="--seed 2 --core-faults 50" chooses others'
	@echo 'make coverage  lines and bits of cores that their own testbenches and harnesses reach; COVERAGE="--only small" takes one core'
	@echo 'make prove     the Verilog equals its combinational form: yosys and z3; DESIGN=x BITS=y II=N proves one unit'
	@echo 'make prove-all-widths  int_major never misses, for all widths: Coq'
	@echo 'make netlists  the netlists in chip cells and standard cells equal the C++ for 10^5 vectors a design'
	@echo 'make hls-check  C++14 tops with the integers in HITPIPE_VENDOR_AP_INT=DIR or HITPIPE_AC_TYPES=DIR, and by bambu'
	@echo 'make alone     every source and header compiles by itself; FILES="WORD..." takes those whose path holds a word'
	@echo 'make fresh     make build, demo and test in a Debian 12 of its own, then README from the packages alone; needs root'
	@echo 'make dist      the last commit as out/hitpipe-VERSION.tar.gz, with the hash of its sources'
	@echo 'make deb       packages of Debian 12 from the last commit in out/deb; needs debhelper, dh-python and lintian'
	@echo 'make clean     removes build folders and out/'

packages:
	@cmake/install-packages.sh --groups $(GROUPS)

build: packages
	@cmake --preset release >build.log 2>&1 || { cat build.log; exit 1; }
	@cmake --build --preset release -j $(JOBS) --target hitpipe hitpipe_shell_files hitpipe_ref hitpipe_python

demo: build
	@build/hitpipe cosim int_slabs --bits 20/24 --scene spheres --width 512 --height 512 --referee --out out/demo
	@echo
	@echo 'Every box test of out/demo/spheres.png was answered by out/demo/int_slabs.v. Next:'
	@echo '  build/hitpipe cosim int_slabs --bits 12/12 --scene spheres --referee   # fewer bits, more false hits'
	@echo '  build/hitpipe rtl int_slabs --bits 24/24 --out out/rtl                 # another format as Verilog'

check: build
	@cmake --build --preset release -j $(JOBS)
	@$(RUN_TESTS) -E $(SLOW)

test: check
	@$(RUN_TESTS) -R $(SLOW)

test-long: packages
	@cmake --preset release
	@cmake --build --preset release -j $(JOBS) --target rays_tests sw_ref_tests sim_tests hitpipe emit_formal emit_lemmas
	@$(if $(TEST_PATH),PATH="$(TEST_PATH)") ctest --preset release -j $(JOBS) -L '^long$$' -V

test-designs: packages
	@cmake --preset release
	@$(if $(TEST_PATH),PATH="$(TEST_PATH)") ctest --preset release -L longest -V

sanitize: packages
	@cmake --preset sanitize -DHITPIPE_TESTED='$(SANITIZED)'
	@cmake --build --preset sanitize -j $(JOBS) --target $(or $(PROGRAMS),test_programs)
	@ctest --preset sanitize -j $(JOBS) -R '$(SANITIZED)' $(if $(PROGRAMS),-L '^($(subst $() ,|,$(strip $(PROGRAMS))))$$')

threads: packages
	@cmake --preset threads -DHITPIPE_TESTED='$(THREADED)' >build.log 2>&1 || { cat build.log; exit 1; }
	@cmake --build --preset threads -j $(JOBS) --target host_tests rays_tests sw_ref_tests
	@ctest --preset threads -j $(JOBS) -R '$(THREADED)' -LE long

fuzz: SECONDS ?= 60
fuzz: packages
	@cmake --preset sanitize >build.log 2>&1 || { cat build.log; exit 1; }
	@cmake --build --preset fuzz -j $(JOBS)
	@tests/fuzz/run.sh build-sanitize/fuzz $(SECONDS)

# MUTANTS: options of tests/mutants/mutants.py.
mutants: build
	@tests/mutants/mutants.py build/hitpipe --jobs $(JOBS) $(MUTANTS)

# COVERAGE: options of tests/coverage/coverage.py.
coverage: build
	@tests/coverage/coverage.py build/hitpipe --jobs $(JOBS) $(COVERAGE)

bench: build
	@cmake --build --preset release -j $(JOBS) --target benchmarks
	@bench/run.sh

# With DESIGN that unit alone; BITS is its format, unless it is the default. With II it takes a test every II cycles.
ifdef DESIGN
prove: build
	@cmake --build --preset release -j $(JOBS) --target emit_formal emit_lemmas >build.log 2>&1 || { cat build.log; exit 1; }
	@tests/formal/prove.sh build/tests/formal/emit_formal build/tests/formal/emit_lemmas build/tests/formal/one '$(DESIGN)' '$(BITS)' $(II)
else
prove: build
	$(if $(BITS)$(II),@echo 'make prove: BITS or II without DESIGN' >&2; exit 1,@cmake --build --preset release -j $(JOBS) --target prove)
endif

# Coq takes 490 MB and serves nothing else, so packages.txt does not name it.
prove-all-widths: packages
	@command -v coqc >/dev/null || cmake/install-packages.sh coq
	@tests/formal/all_widths/prove.sh

netlists: build
	@tests/sim/implement/netlists.sh

hls-check: build
	@tests/hls/hls_check.sh build/hitpipe . || [ $$? = 77 ]

alone: packages
	@cmake --preset alone >build.log 2>&1 || { cat build.log; exit 1; }
	@tests/platform/each_alone.py build/alone $(FILES)

fresh:
	@cmake/fresh.sh
	@cmake/deb.sh out/deb
	@cmake/fresh.sh --packages out/deb

dist:
	@cmake/dist.sh out

deb:
	@cmake/deb.sh out/deb

lint: packages
	@clang-format --dry-run --Werror $(CXX_FILES)
	@cmake --preset lint >build.log 2>&1 || { cat build.log; exit 1; }
	@tests/platform/tidy.py build/lint $(JOBS)

format:
	@clang-format -i $(CXX_FILES)

clean:
	rm -rf build build-debug build-sanitize build-threads out build.log
