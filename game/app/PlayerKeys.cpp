// What the player's keys do beside the dive itself.
#include "game/app/Player.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace shoal::app {

const platform::WindowInput& Player::readKeys(Run& run, double now_s) {
    const platform::WindowInput& input = window->poll();
    leaving |= input.closing;
    const bool results = run.after.phase == game::Phase::Results;
    const bool mine = playedByAPerson(run.source);
    // A headset's player looks at no window; whether it is worn is for XrPlay to say.
    if (mine && !headset && !input.focused && !results) run.paused = true;
    for (const int key : input.keysPressed) {
        switch (key) {
        case GLFW_KEY_ESCAPE:
            if (results || !mine)
                leaving = true;
            else
                run.paused = !run.paused;
            break;
        case GLFW_KEY_P:
            run.paused = mine && !run.paused && !results;
            break;
        case GLFW_KEY_Q:
            leaving |= run.paused || results;
            break;
        case GLFW_KEY_R:
            run.restart |= run.paused || results;
            break;
        case GLFW_KEY_ENTER:
            run.restart |= results;
            break;
        case GLFW_KEY_F1:
            showTimes = !showTimes;
            break;
        case GLFW_KEY_F11:
            window->toggleFullscreen();
            break;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            volume = std::min(1.0f, volume + 0.1f);
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            volume = std::max(0.0f, volume - 0.1f);
            break;
        default:
            continue;
        }
        if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_ADD ||
            key == GLFW_KEY_KP_SUBTRACT) {
            outputs->setVolume(volume);
            volumeShown_s = now_s;
        }
    }
    if (input.leftPressed && results) run.restart = true;
    if (run.restart) run.paused = false;
    return input;
}

} // namespace shoal::app
