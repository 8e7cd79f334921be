# Lists the functions of <cmath> and <complex> whose results differ between C libraries or processors. The other functions (sqrt,
# fma, floor, fmod, remainder, ldexp …) are exact by IEEE 754 everywhere, and libm computes them.

# These functions come from musl: those of double and float, and the complex ones that musl computes with the same care.
set(MUSL_FUNCTIONS)
foreach(name sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 log10 log1p
    pow cbrt hypot erf erfc tgamma)
  list(APPEND MUSL_FUNCTIONS ${name} ${name}f)
endforeach()
list(APPEND MUSL_FUNCTIONS lgamma_r lgammaf_r
  cexp csqrt csin ccos ctan csinh ccosh ctanh)

# wider.c has these functions: musl computes some of them imprecisely, and the others are for long double and complex numbers.
set(WIDER_FUNCTIONS lgamma lgammaf exp10 exp10f)
foreach(name sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 log10
    log1p pow cbrt hypot erf erfc tgamma lgamma)
  list(APPEND WIDER_FUNCTIONS ${name}l)
endforeach()
list(APPEND WIDER_FUNCTIONS lgammal_r)
list(APPEND WIDER_FUNCTIONS clog)
foreach(name cexp clog csqrt csin ccos ctan csinh ccosh ctanh)
  list(APPEND WIDER_FUNCTIONS ${name}f ${name}l)
endforeach()
foreach(name cabs carg cpow clog10 casin cacos catan casinh cacosh catanh)
  list(APPEND WIDER_FUNCTIONS ${name} ${name}f ${name}l)
endforeach()

# If long double has 113 bits, libm computes its functions in integers, and they stay libm's.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  list(FILTER WIDER_FUNCTIONS EXCLUDE REGEX "l(_r)?$")
endif()

# reproducible_math_alias(SYMBOL OUTPUT) sets OUTPUT to the function of ours that libm's SYMBOL is another name for. It is empty if
# there is no such function.
function(reproducible_math_alias symbol output)
  set(names ${MUSL_FUNCTIONS} ${WIDER_FUNCTIONS})
  set(${output} "" PARENT_SCOPE)
  string(REGEX REPLACE "^__(.*)_finite$" "\\1" symbol ${symbol})
  string(REGEX REPLACE "^gamma" "lgamma" symbol ${symbol})
  string(REGEX MATCH "_r$" ending ${symbol})
  string(REGEX REPLACE "_r$" "" stem ${symbol})
  string(REGEX REPLACE "f(64|32x)$" "" as_double ${stem})
  string(REGEX REPLACE "f32$" "f" as_float ${stem})
  string(REGEX REPLACE "f64x$" "l" as_long_double ${stem})
  foreach(name IN ITEMS ${stem} ${as_double} ${as_float} ${as_long_double})
    if(${name}${ending} IN_LIST names)
      set(${output} ${name}${ending} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()
