/* The most that one core computes: fused multiply-adds on twelve independent vectors, enough to hide
   their latency and few enough to stay in registers. */

#if defined(__AVX512F__)
enum { BYTES = 64 };
#elif defined(__AVX__)
enum { BYTES = 32 };
#else
enum { BYTES = 16 };
#endif

typedef double vector __attribute__((vector_size(BYTES)));
enum { VECTORS = 12, LANES = BYTES / sizeof(double) };

/* Returns the number of floating-point operations. `values` holds VECTORS numbers to start from;
   their sum goes back into the first, so that nothing can be left out. */
double multiply_add(long rounds, double factor, double summand, double *values)
{
    const vector b = factor + (vector){0}, c = summand + (vector){0};
    vector v[VECTORS], sum = {0};
    for (int i = 0; i < VECTORS; i++)
        v[i] = values[i] + (vector){0};
    for (long k = 0; k < rounds; k++)
        for (int i = 0; i < VECTORS; i++)
            v[i] = v[i] * b + c;
    for (int i = 0; i < VECTORS; i++)
        sum += v[i];
    values[0] = sum[0];
    return 2.0 * VECTORS * LANES * rounds;
}
