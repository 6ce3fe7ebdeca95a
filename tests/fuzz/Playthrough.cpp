// A scripted playthrough.
#include "game/playthrough/Script.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input.toml");
    const auto script = game::loadScript(file({data, size}));
    if (script)
        for (const game::ScriptStep& step : script->steps) fuzz::expect(step.hand == 0 || step.hand == 1);
    return 0;
}
