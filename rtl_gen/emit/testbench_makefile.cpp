#include "rtl_gen/emit/testbench.hpp"

namespace hitpipe::rtl {

std::string testbench_makefile() {
  return R"(# Simulates the units that have a testbench in this folder. Each target fails when a vector does.
#   make icarus       the testbench in Icarus Verilog (11 or later)
#   make verilator    the testbench in Verilator (5.006 or later)
#   make harness      the C++ program that drives the unit as Verilator compiles it
#   make waves        the testbench in Icarus Verilog; writes UNIT.vcd
#   make clean        removes all that these have written
# A unit in a wrapper has a testbench for each wrapper too; the C++ program drives the unit itself. Of a core it is a small system.
# With WAVES=vcd or WAVES=fst each of them writes waves in that format. UNITS=NAME takes one unit of several.
UNITS := $(patsubst %_tb.sv,%,$(wildcard *_tb.sv))
# A core's program has a folder of its own.
HARNESS = $(or $(wildcard $(1)_harness/harness.cpp),$(wildcard $(1)_harness.cpp))
BARE := $(foreach module,$(UNITS) $(UNITS:%=%_axi),$(and $(call HARNESS,$(module)),$(module)))
IVERILOG := iverilog
VVP := vvp
VERILATOR := verilator
# A unit that was fitted to a scene checks its operands; other units do not read this.
DEFINES := -DHITPIPE_CHECK

ifneq ($(filter-out vcd fst,$(WAVES)),)
$(error WAVES=$(WAVES): allowed are vcd and fst)
endif
TRACE_vcd := --trace
TRACE_fst := --trace-fst
TRACE := $(TRACE_$(WAVES))

.PHONY: icarus verilator harness waves clean
icarus: $(UNITS:%=icarus-%)
# Units of a core have no file of their own. `make verilator-UNIT` runs one of them.
verilator: $(addprefix verilator-,$(foreach unit,$(UNITS),$(and $(wildcard ../$(unit).v),$(unit))))
harness: $(BARE:%=harness-%)
waves:
	$(MAKE) icarus WAVES=$(or $(WAVES),vcd)

# Verilator and make see for themselves what must be compiled again. Verilator cannot build in a folder with a blank in its
# name; then the build is in a temporary folder.
ROOM := $(if $(word 2,$(CURDIR)),$(or $(TMPDIR),/tmp)/hitpipe-$(shell id -u)-$(shell pwd | cksum | tr ' ' -),build)
BUILD = $(ROOM)/$(1)_$*$(WAVES:%=_%)
RUN_WAVES = $(if $(WAVES),+waves=$*.$(WAVES))
FILE = $(shell grep -l '^module $* ' ../*.v)
COMPILE = $(VERILATOR) -Wall $(TRACE) $(DEFINES) -j 0 -MAKEFLAGS -s -Mdir

.PHONY: $(UNITS:%=icarus-%) $(UNITS:%=verilator-%) $(BARE:%=harness-%)
$(UNITS:%=icarus-%): icarus-%:
	@mkdir -p $(ROOM)
	$(IVERILOG) -g2012 -Wall $(DEFINES) -s $*_tb -y .. -o $(call BUILD,icarus) $*_tb.sv $(FILE)
	$(VVP) -n $(call BUILD,icarus) $(if $(WAVES),-$(WAVES)) $(RUN_WAVES)

$(UNITS:%=verilator-%): verilator-%:
	@mkdir -p $(ROOM)
	$(COMPILE) $(call BUILD,tb) --binary --top-module $*_tb -y .. $*_tb.sv $(FILE)
	$(call BUILD,tb)/V$*_tb $(RUN_WAVES)

$(BARE:%=harness-%): harness-%:
	@mkdir -p $(call BUILD,harness)
	@cp -R $(wildcard $*_harness.cpp $*_harness ../*.h) $(call BUILD,harness)
	$(COMPILE) $(call BUILD,harness) --cc --exe --build --top-module $* -y .. ../$*.v $(call HARNESS,$*)
	$(call BUILD,harness)/V$*

clean:
	rm -rf $(ROOM) $(UNITS:%=%.vcd) $(UNITS:%=%.fst)
)";
}

}  // namespace hitpipe::rtl
