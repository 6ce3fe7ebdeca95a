// One version of combine(), which ZonalFilter.cpp describes and includes: SHOAL_TARGET is its processor
// attribute, SHOAL_FLOATS the number of floats in a register.
SHOAL_TARGET
void combine(const float* kernel, int count, ptrdiff_t step, const std::array<const float*, kSignals>& in,
             float* out) {
    using Vector = float __attribute__((vector_size(4 * SHOAL_FLOATS)));
    const float *inA = in[0], *inB = in[1], *inC = in[2], *inD = in[3], *inE = in[4], *inF = in[5];
    for (int part = 0; part < kRows; part += SHOAL_FLOATS) {
        Vector a{}, b{}, c{}, d{}, e{}, f{};
        for (int row = 0; row < count; ++row) {
            Vector weights;
            std::memcpy(&weights, kernel + row * kRows + part, sizeof weights);
            const ptrdiff_t at = row * step;
            a += weights * inA[at];
            b += weights * inB[at];
            c += weights * inC[at];
            d += weights * inD[at];
            e += weights * inE[at];
            f += weights * inF[at];
        }
        float* to = out + part;
        for (const Vector* sum : {&a, &b, &c, &d, &e, &f}) {
            std::memcpy(to, sum, sizeof *sum);
            to += kRows;
        }
    }
}
#undef SHOAL_TARGET
#undef SHOAL_FLOATS
