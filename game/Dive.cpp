#include "game/Dive.h"

#include "game/World.h"

namespace shoal::game {

Dive::Dive(SpeciesTable species, DiveFile file, uint64_t seed)
    : world_(std::make_unique<World>(std::move(species), std::move(file), seed)) {}
Dive::~Dive() = default;
Dive::Dive(Dive&&) noexcept = default;
Dive& Dive::operator=(Dive&&) noexcept = default;

void Dive::step(const TickInput& input, std::vector<Event>& out) { world_->step(input, out); }
void Dive::snapshot(Snapshot& out) const {
    world_->fill(out);
    out.shelter = shelterAt(world_->file.shelter, world_->file.videoLength_s, out.time_s);
    out.ground = groundAt(world_->file.ground, world_->file.videoLength_s, out.time_s);
}
uint64_t Dive::stateHash() const { return world_->hash(); }
uint64_t Dive::seed() const { return world_->seed; }
const SpeciesTable& Dive::species() const { return world_->species; }
const DiveFile& Dive::file() const { return world_->file; }

} // namespace shoal::game
