// Headers and small helpers that nearly all tests use, precompiled for the test programs.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/light/FrameView.h"
#include "tests/TestPaths.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <source_location>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shoal {

inline light::FrameView viewOf(const ImageRgb8& frame, bool bgr = false) {
    return {frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, bgr};
}

// Returns a frame of one colour.
inline ImageRgb8 evenFrame(int width, int height, uint8_t red, uint8_t green, uint8_t blue) {
    ImageRgb8 frame(width, height);
    for (size_t i = 0; i < frame.pixels.size(); i += 3)
        frame.pixels[i] = red, frame.pixels[i + 1] = green, frame.pixels[i + 2] = blue;
    return frame;
}

namespace tests {

// Returns the result's value; without one the test fails with the reason and the place of the call.
template <class T>
T valueOf(Result<T> result, const std::source_location& at = std::source_location::current()) {
    if (result) return std::move(result).value();
    throw std::runtime_error(at.file_name() + (":" + std::to_string(at.line())) + ": " +
                             result.error().message());
}

template <class T>
T valueOf(std::optional<T> value, const std::source_location& at = std::source_location::current()) {
    return valueOf(value ? Result<T>(*std::move(value)) : Error{"", "there is none"}, at);
}

// Returns the result's error; with a value, an error without a reason.
template <class T> Error errorOf(const Result<T>& result) { return result ? Error{} : result.error(); }

// Returns success for a value, else failure with the reason of the error.
template <class T> testing::AssertionResult succeeded(const Result<T>& result) {
    return result ? testing::AssertionSuccess() : testing::AssertionFailure() << result.error().message();
}

// Names the cases of a suite by the member of their parameters.
inline const auto byName = [](const auto& info) { return std::string(info.param.name); };

} // namespace tests
} // namespace shoal
