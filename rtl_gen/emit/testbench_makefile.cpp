#include "rtl_gen/emit/testbench.hpp"

namespace hitpipe::rtl {

std::string testbench_makefile() {
  return R"(# Simulates the units that have a testbench in this folder. Each target fails when a vector does.
#   make icarus       the testbench in Icarus Verilog (11 or later)
#   make verilator    the testbench in Verilator (5.006 or later)
#   make harness      the C++ program that drives the unit as Verilator compiles it
#   make waves        the testbench in Icarus Verilog; writes UNIT.vcd
#   make clean        removes all that these have written
# With WAVES=vcd or WAVES=fst each of them writes waves in that format. UNITS=NAME takes one unit of several.
UNITS := $(patsubst %_tb.sv,%,$(wildcard *_tb.sv))
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
verilator: $(UNITS:%=verilator-%)
harness: $(UNITS:%=harness-%)
waves:
	$(MAKE) icarus WAVES=$(or $(WAVES),vcd)

# Verilator and make see for themselves what must be compiled again.
BUILD = build/$(1)_$*$(WAVES:%=_%)
RUN_WAVES = $(if $(WAVES),+waves=$*.$(WAVES))
COMPILE = $(VERILATOR) -Wall $(TRACE) $(DEFINES) -j 0 -MAKEFLAGS -s -Mdir

.PHONY: $(UNITS:%=icarus-%) $(UNITS:%=verilator-%) $(UNITS:%=harness-%)
$(UNITS:%=icarus-%): icarus-%:
	@mkdir -p build
	$(IVERILOG) -g2012 -Wall $(DEFINES) -s $*_tb -o $(call BUILD,icarus) $*_tb.sv ../$*.v
	$(VVP) -n $(call BUILD,icarus) $(if $(WAVES),-$(WAVES)) $(RUN_WAVES)

$(UNITS:%=verilator-%): verilator-%:
	@mkdir -p build
	$(COMPILE) $(call BUILD,tb) --binary --top-module $*_tb $*_tb.sv ../$*.v
	$(call BUILD,tb)/V$*_tb $(RUN_WAVES)

$(UNITS:%=harness-%): harness-%:
	@mkdir -p build
	$(COMPILE) $(call BUILD,harness) --cc --exe --build --top-module $* ../$*.v $(CURDIR)/$*_harness.cpp
	$(call BUILD,harness)/V$*

clean:
	rm -rf build $(UNITS:%=%.vcd) $(UNITS:%=%.fst)
)";
}

}  // namespace hitpipe::rtl
