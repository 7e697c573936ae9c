#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST)
#error "This code needs the arithmetic of IEEE 754: compile it without -ffast-math, /fp:fast and the like."
#endif
#if defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ > 0)
#error "This code recognizes NaN and infinity: compile it without -ffinite-math-only."
#endif
