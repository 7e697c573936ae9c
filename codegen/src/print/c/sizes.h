/* Sizes of arrays that functions take: at least so many elements. Arrays with ABBE_RESTRICT overlap no others. */
#if defined(__cplusplus) || defined(ABBE_PLAIN_SIZES) || (defined(_MSC_VER) && !defined(__clang__))
#define ABBE_SIZE(count) (count)
#define ABBE_RESTRICT(count) (count)
#else
#define ABBE_SIZE(count) static (count)
#define ABBE_RESTRICT(count) restrict static (count)
#endif
