#include "apps/FrameRange.h"

#include <charconv>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::app {

namespace {

/// Parses at most three integers separated by colons; empty for any other text.
std::vector<int> numbersBetweenColons(const std::string& text) {
    std::vector<int> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (numbers.size() < 3) {
        int number = 0;
        const auto [rest, error] = std::from_chars(at, end, number);
        if (error != std::errc()) return {};
        numbers.push_back(number);
        if (rest == end) return numbers;
        if (*rest != ':') return {};
        at = rest + 1;
    }
    return {};
}

} // namespace

FrameRange frameRangeNamed(const std::string& text) {
    const std::vector<int> numbers = numbersBetweenColons(text);
    if (numbers.empty())
        throw InputError(fmt::format("--frames '{}' is not a whole number of pictures, such as 90, nor the first and "
                                     "the last frame, such as 10:19, with a step, such as 10:19:3; no number is above "
                                     "{}",
                                     text, std::numeric_limits<int>::max()));
    if (numbers.size() == 1 && numbers[0] < 1)
        throw InputError(fmt::format("--frames {} is less than one picture; give 1 or more", text));
    FrameRange range;
    range.last = numbers[0] - 1;
    if (numbers.size() > 1) {
        range = {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 1};
        if (range.first < 0)
            throw InputError(fmt::format("--frames {}: frames are counted from 0; give --time for earlier ones", text));
        if (range.last < range.first)
            throw InputError(fmt::format("--frames {} ends before it begins; give the lower frame first", text));
        if (range.step < 1) throw InputError(fmt::format("--frames {}: the step is less than 1; give 1 or more", text));
    }
    if ((range.last - range.first) / range.step >= kMostFrames)
        throw InputError(fmt::format("--frames {} is more than {} pictures; render it in parts, such as 0:{}", text,
                                     kMostFrames, kMostFrames - 1));
    return range;
}

} // namespace tessera::app
