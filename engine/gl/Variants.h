// One shader pair compiled with different sets of features. Software renderers run both sides of every
// branch, and graphics cards hold registers for both, so what is known before a draw is decided by the
// preprocessor.
#pragma once

#include "engine/gl/Program.h"

#include <map>
#include <span>
#include <string>

namespace shoal::gl {

class Variants {
  public:
    Variants() = default;
    // names: of the features, bit by bit; must live as long as this. Nothing is compiled yet.
    Variants(std::string stem, std::span<const char* const> names) : stem_(std::move(stem)), names_(names) {}

    // Compiled when first asked for; the pointer stays good. glsl: as Program::load() has it.
    Result<const Program*> get(unsigned features, int glsl = 330) {
        if (const auto found = programs_.find(features); found != programs_.end()) return &found->second;
        std::vector<std::string> defines;
        for (size_t bit = 0; bit < names_.size(); ++bit)
            if (features & (1u << bit)) defines.emplace_back(names_[bit]);
        auto program = Program::load(stem_, defines, glsl);
        if (!program) return program.error();
        return &programs_.emplace(features, std::move(*program)).first->second;
    }

  private:
    std::string stem_;
    std::span<const char* const> names_;
    std::map<unsigned, Program> programs_;
};

} // namespace shoal::gl
