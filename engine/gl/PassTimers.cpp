#include "engine/gl/PassTimers.h"

#include <algorithm>
#include <limits>

namespace shoal::gl {

namespace {
constexpr size_t kNone = std::numeric_limits<size_t>::max();
}

PassTimers::Scope::Scope(PassTimers* timers, const char* pass)
    : timers_(timers), span_(kNone), onThread_(timers ? &timers->onThread_ : nullptr, pass) {
    if (timers && timers->groups_) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, pass);
    if (!timers || !timers->measured_) return;
    Frame& frame = timers->frames_[timers->current_];
    span_ = frame.used++;
    if (span_ == frame.spans.size()) frame.spans.push_back({pass, Query::make(), Query::make()});
    frame.spans[span_].pass = pass;
    glQueryCounter(frame.spans[span_].begin.name(), GL_TIMESTAMP);
}

PassTimers::Scope::~Scope() {
    if (span_ != kNone)
        glQueryCounter(timers_->frames_[timers_->current_].spans[span_].end.name(), GL_TIMESTAMP);
    if (timers_ && timers_->groups_) glPopDebugGroup();
}

void PassTimers::read(Frame& frame) {
    if (frame.used == 0) return;
    GLint there = 0;
    glGetQueryObjectiv(frame.spans[frame.used - 1].end.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) return;
    times_.clear();
    for (const Span& span : std::span(frame.spans).first(frame.used)) {
        GLuint64 begin_ns = 0, end_ns = 0;
        glGetQueryObjectui64v(span.begin.name(), GL_QUERY_RESULT, &begin_ns);
        glGetQueryObjectui64v(span.end.name(), GL_QUERY_RESULT, &end_ns);
        const auto same = std::ranges::find_if(
            times_, [&](const Time& time) { return std::string_view(time.pass) == span.pass; });
        const float gpu_ms = static_cast<float>(end_ns - begin_ns) * 1e-6f;
        if (same != times_.end())
            same->gpu_ms += gpu_ms; // sum of both eyes
        else
            times_.push_back({span.pass, gpu_ms});
    }
}

void PassTimers::beginFrame(bool measured) {
    onThread_.beginFrame();
    measured_ = measured;
    current_ = (current_ + 1) % frames_.size();
    read(frames_[current_]); // the oldest
    frames_[current_].used = 0;
}

} // namespace shoal::gl
