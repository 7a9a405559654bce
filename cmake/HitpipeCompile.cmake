# Warnings and sanitizers that every target of the project shares.
add_library(hitpipe_compile INTERFACE)
target_compile_options(hitpipe_compile INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(HITPIPE_WERROR)
  target_compile_options(hitpipe_compile INTERFACE -Werror)
endif()
if(HITPIPE_SANITIZE)
  target_compile_options(hitpipe_compile INTERFACE
    -fsanitize=${HITPIPE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(hitpipe_compile INTERFACE -fsanitize=${HITPIPE_SANITIZE})
endif()
