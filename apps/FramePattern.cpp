#include "apps/FramePattern.h"

#include <regex>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::app {

bool FramePattern::hasPlace(const std::filesystem::path& file) {
    static const std::regex likely("%0?[1-9]d|%d(?![A-Za-z])"); // not "100%done"
    return std::regex_search(file.filename().string(), likely);
}

FramePattern::FramePattern(const std::string& pattern) {
    static const std::regex place("%(0?)([1-9]?)d");
    const auto first = std::sregex_iterator(pattern.begin(), pattern.end(), place);
    if (std::distance(first, std::sregex_iterator()) != 1) {
        throw InputError(
            fmt::format("{}: a sequence needs exactly one place for the frame number, as in f_%04d.png", pattern));
    }
    before_ = first->prefix();
    after_ = first->suffix();
    if (first->length(2) > 0) digits_ = std::size_t(std::stoi(first->str(2)));
}

std::string FramePattern::path(int frame) const {
    const std::string number = std::to_string(frame);
    const std::size_t missing = digits_ > number.size() ? digits_ - number.size() : 0;
    return before_ + std::string(missing, '0') + number + after_;
}

} // namespace tessera::app
