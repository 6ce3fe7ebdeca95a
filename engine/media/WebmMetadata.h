// Internal to this room; see SphericalMetadata.h.
#pragma once

#include "engine/media/BoundedStream.h"
#include "engine/media/SphericalMetadata.h"

namespace shoal::media {

SphericalMetadata webmMetadataOf(const BoundedStream& file);

} // namespace shoal::media
