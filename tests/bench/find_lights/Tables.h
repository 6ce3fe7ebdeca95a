// Tables that bench_lights prints after those of found lights.
#pragma once

namespace shoal::bench {

void growPhotos(bool quick);
void findWater(bool quick);

} // namespace shoal::bench
