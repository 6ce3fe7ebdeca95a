// Axes that are spread evenly: each row stands for four, its own and those with y, z or both turned round, so that what is
// said of one says most of the others. Points that push each other off, and their images; a cosine summed over all is within
// a hundredth of its integral. Light's frame. C++ reads it too.
AXES(0, 0.24806, 0.93645, 0.24806)
AXES(1, 0.26973, 0.68090, 0.68090)
AXES(2, 0.68090, 0.68090, 0.26973)
AXES(3, 0.68090, 0.26973, 0.68090)
AXES(4, 0.24806, 0.24806, 0.93645)
AXES(5, 0.93645, 0.24806, 0.24806)
