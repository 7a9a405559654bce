# The thesis's experiments and the paging model.
hitpipe_test(experiment_test IN sw_ref_tests SOURCES experiment/experiment_test.cpp experiment/interval_test.cpp
  experiment/paging_test.cpp experiment/proposals_test.cpp experiment/verdict_test.cpp LIBS hitpipe_sw_ref)
