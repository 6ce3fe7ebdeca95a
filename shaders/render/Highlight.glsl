// Returns how far towards white a surface that is marked for the player is drawn, 0 to 1: a little all over, as fish are flat,
// and more towards the rim. highlight: 0 to 1. facing: cosine between its normal and the direction to the eye.
float highlightOf(float highlight, float facing) {
    float edge = 1.0 - clamp(abs(facing), 0.0, 1.0);
    return highlight * (0.24 + edge * (0.25 + 0.45 * edge * edge));
}
