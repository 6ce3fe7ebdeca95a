// The screens of a program that keeps its files in a scratch folder and speaks English.
#pragma once

#include "game/app/Screens.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace shoal::app {

class WithScreens : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    PlayOptions options_;
    Bindings bindings_;
    Screens screens_{options_, bindings_};
    game::SpeciesTable species_{{.name = "snapper",
                                 .one = {"snapper", "Schnapper", "vivaneau"},
                                 .several = {"snappers", "Schnapper", "vivaneaux"}}};
    game::DiveFile dive_;

    void SetUp() override {
        for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "HOME"})
            ::setenv(variable, folder_.path().c_str(), 1);
        ::setenv("LC_ALL", "C", 1);
        screens_.facts.species = &species_;
        screens_.facts.dive = &dive_;
        screens_.facts.dives = {{.name = "reef", .title = "The reef"},
                                {.name = "night", .title = "The reef by night", .best = 90}};
    }

    const MenuPage& page() const { return screens_.menu().page(); }
    size_t find(std::string_view label) const {
        const auto item = std::ranges::find(page().items, label, &MenuItem::label);
        return static_cast<size_t>(item - page().items.begin());
    }
};

} // namespace shoal::app
