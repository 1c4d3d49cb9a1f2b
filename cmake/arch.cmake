# In: the machine that builds. Out: SAHL_ARCH, the value of -march, or nothing for the compiler's own default.
# Where the machine has AVX2 and FMA, std::fma is one instruction instead of a call, and Fresnel's formulas take half
# the time; results are the same either way. Give SAHL_ARCH= (nothing) to build for machines other than this one.
set(default_arch "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND NOT CMAKE_CROSSCOMPILING AND EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags" LIMIT_COUNT 1)
  set(needed avx avx2 bmi1 bmi2 f16c fma abm movbe) # what x86-64-v3 adds, as Linux names it
  string(REPLACE " " ";" flags "${flags}")
  list(REMOVE_ITEM needed ${flags})
  if(NOT needed)
    set(default_arch x86-64-v3)
  endif()
endif()
set(SAHL_ARCH "${default_arch}" CACHE STRING "Value of -march; empty: the compiler's default")
