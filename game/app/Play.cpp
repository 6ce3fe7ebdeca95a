#include "game/app/Commands.h"

#include "engine/core/Log.h"
#include "game/app/Player.h"
#include "game/app/Scores.h"
#include "game/app/Settings.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <variant>

namespace shoal::app {

namespace {

constexpr double kSlowestFrame_s = 0.5;

} // namespace

void Player::keepScore(const Run& run) {
    const bool results = run.after.phase == game::Phase::Results;
    if (!results) {
        scored = newBest = false;
        return;
    }
    if (scored) return;
    scored = true;
    if (run.after.score <= best) return;
    best = run.after.score;
    newBest = true;
    // Only what a person has played counts.
    if (!options.headless && playedByAPerson(run.source))
        if (Status saved = saveBestScore(plan.dive.name, best); !saved)
            log::warn("{}", saved.error().sentence());
}

// Once a frame has been drawn, before the display is waited for.
void Player::govern(Clock::time_point frameBegan) {
    glFinish();
    governor->frame(secondsBetween(frameBegan, Clock::now()) * 1e3);
    const Quality quality = governor->quality();
    surround->setLightEvery(quality.lightEvery);
    statistics.leastScale = std::min(statistics.leastScale, quality.scale);
}

// One run from start to end. measured: its frames go into the statistics.
Status Player::playThrough(bool measured) {
    Run run(plan);
    const bool keep = !options.record.empty();
    const Clock::time_point began = Clock::now();
    Clock::time_point last = began;
    for (uint64_t frame = 0; !leaving; ++frame) {
        if (headset) {
            if (Status waited = headset->wait(); !waited) return waited;
            leaving |= headset->leaving();
            if (!governor && options.quality == "auto" && !options.timedemo && headset->period_s() > 0)
                governor.emplace(1000 * headset->period_s());
        }
        const Clock::time_point now = Clock::now();
        const double wall_s = std::min(secondsBetween(last, now), kSlowestFrame_s);
        last = now;
        // With a player in front, time is the clock's; else each picture is 1 / fps after the one before.
        const bool live = window && !options.timedemo;
        double elapsed_s = headset      ? std::min(headset->elapsed_s(), kSlowestFrame_s)
                           : live       ? wall_s
                           : frame == 0 ? 0
                                        : 1.0 / static_cast<double>(options.fps);
        const platform::WindowInput* input = window ? &readKeys(run, glfwGetTime()) : nullptr;
        if (headset) {
            headset->feed(run, plan.rig);
            if (run.paused && !playedByAPerson(run.source)) elapsed_s = 0; // a script waits for its onlooker
        }
        if (auto* mouse = std::get_if<MouseSource>(&run.source)) {
            const glm::ivec2 size = window ? window->framebufferSize() : options.look.size;
            mouse->frame(window ? &*window : nullptr, input, run.shown, static_cast<float>(elapsed_s),
                         glm::radians(options.fov_deg),
                         static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1)));
        }
        const Clock::time_point simBegan = Clock::now();
        run.advance(elapsed_s, keep);
        times.sim_ms = static_cast<float>(secondsBetween(simBegan, Clock::now()) * 1e3);
        outputs->frame(run.shown, run.events, static_cast<float>(elapsed_s),
                       headset || !input || input->focused, surround->videoPosition_s());
        if (headset)
            if (Status felt = headset->feel(outputs->felt(), run.paused); !felt) return felt;
        keepScore(run);

        // The video begins with the dive, pauses with it, and begins anew with it.
        const bool exact = !window && !options.timedemo;
        const bool fresh = surround->update(
            options.timedemo ? secondsBetween(began, Clock::now()) : run.shown.time_s, exact);
        if (fresh && measured) {
            statistics.light_ms.add(static_cast<double>(surround->light_ms()));
            statistics.decode_ms.add(static_cast<double>(surround->decode_ms()));
            statistics.upload_ms.add(static_cast<double>(surround->upload_ms()));
        }
        times.light_ms = surround->light_ms();
        times.decode_ms = surround->decode_ms();
        times.upload_ms = surround->upload_ms();

        const glm::ivec2 size = window ? window->framebufferSize() : options.look.size;
        if (headset) {
            if (Status drawn = drawHeadset(run, size); !drawn) return drawn;
            if (governor && headset->drew()) govern(now);
            if (headset->drew()) window->present();
        } else if (size.x > 0 && size.y > 0) { // not while minimised
            if (Status drawn = drawFrame(run, size); !drawn) return drawn;
            while (secondsBetween(now, Clock::now()) * 1e3 < static_cast<double>(options.load_ms)) {
            }
            if (governor) govern(now);
            if (window) {
                const int eyes = static_cast<int>(targets.size());
                for (int eye = 0; eye < eyes; ++eye)
                    targets[static_cast<size_t>(eye)].blitTo(0, eye * size.x / eyes, size.x / eyes, size.y);
                window->present();
            }
        }
        glFinish();
        const double frame_ms = secondsBetween(now, Clock::now()) * 1e3;
        times.add(static_cast<float>(frame_ms));
        if (measured && frame > 0) statistics.frame_ms.add(frame_ms);
        if (const media::LivePlayer* stream = surround->live(); stream && measured) {
            statistics.live.add(*stream, fresh && frame > 0);
            // What is live has the clock's time: a dive without a player goes no faster.
            if (!window && !options.timedemo)
                std::this_thread::sleep_until(
                    began + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                                static_cast<double>(frame + 1) / static_cast<double>(options.fps))));
        }

        if (run.ended) break;
        if (options.at_s && run.shown.time_s >= static_cast<double>(*options.at_s)) break;
        if (options.at_s && static_cast<double>(frame) >= static_cast<double>(*options.at_s * options.fps) &&
            !window)
            break;
        const bool alone = !window && std::holds_alternative<MouseSource>(run.source);
        if ((alone || options.timedemo) && std::holds_alternative<MouseSource>(run.source) &&
            run.after.phase == game::Phase::Results)
            break;
    }
    statistics.draws = times.draws;
    statistics.triangles = times.triangles;
    statistics.caught = run.after.caught;
    statistics.score = run.after.score;
    statistics.stateHash = run.dive.stateHash();
    statistics.ticks = run.ticks;
    if (keep && measured)
        if (Status written = sim::writeRecording(options.record, run.recording); !written) return written;
    return run.verdict;
}

int play(const PlayOptions& options) {
    const auto failed = [](const Error& error) {
        log::error("{}", error.sentence());
        return 1;
    };
    Player player(options);
    if (Status opened = player.open(); !opened) return failed(opened.error());
    Status verdict = Done{};
    if (options.timedemo) verdict = player.playThrough(false);
    if (verdict) verdict = player.playThrough(true);
    if (!options.headless && player.volume != options.volume) {
        Settings settings = loadSettings();
        settings.volume = player.volume;
        if (Status saved = saveSettings(settings); !saved) log::warn("{}", saved.error().sentence());
    }
    // What was asked for is written even when an expectation failed: it helps to see why.
    if (!options.screenshot.empty() && !player.drawn().empty())
        if (Status saved = player.saveScreenshot(); !saved) return failed(saved.error());
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, player.statistics); !written)
            return failed(written.error());
    if (options.timedemo)
        std::printf("%s: %zu frames, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
                    player.statistics.renderer.c_str(), player.statistics.frame_ms.count(),
                    player.statistics.frame_ms.quantile(0.5), player.statistics.frame_ms.quantile(0.99),
                    player.statistics.frame_ms.quantile(1));
    if (options.timedemo && player.surround->live())
        std::printf("%s\n", describe(player.statistics.live).c_str());
    if (!verdict) return failed(verdict.error());
    return 0;
}

} // namespace shoal::app
