// Axes that are evenly spread: each row stands for four, its own and those with y, z or both negated, so that most of a
// computation serves all four. They were found as points that repel each other and their mirror images. A
// cosine summed over all is within a hundredth of its integral. Light's frame. C++ reads this file too.
AXES(0, 0.24806, 0.93645, 0.24806)
AXES(1, 0.26973, 0.68090, 0.68090)
AXES(2, 0.68090, 0.68090, 0.26973)
AXES(3, 0.68090, 0.26973, 0.68090)
AXES(4, 0.24806, 0.24806, 0.93645)
AXES(5, 0.93645, 0.24806, 0.24806)
