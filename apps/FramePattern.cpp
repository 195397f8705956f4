#include "apps/FramePattern.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::app {

bool FramePattern::hasPlace(const std::filesystem::path& file) {
    static const std::regex likely("%0[1-9]d|%d(?![A-Za-z])"); // not "100%done"
    return std::regex_search(file.filename().string(), likely);
}

FramePattern::FramePattern(const std::string& pattern) {
    static const std::regex place("%(0([1-9]))?d");
    const std::string name = std::filesystem::path(pattern).filename().string();
    std::smatch found;
    if (std::ranges::count(name, '%') != 1 || !std::regex_search(name, found, place))
        throw InputError(fmt::format("{}: a sequence needs exactly one place for the frame number in the name of its "
                                     "files, and no other %: %d, or %04d for four digits, as in f_%04d.png",
                                     pattern));
    before_ = pattern.substr(0, pattern.size() - name.size()) + found.prefix().str();
    after_ = found.suffix();
    if (found.length(2) > 0) digits_ = std::size_t(std::stoi(found.str(2)));
}

std::string FramePattern::path(int frame) const {
    const std::string number = std::to_string(frame);
    const std::size_t missing = digits_ > number.size() ? digits_ - number.size() : 0;
    return pathWith(std::string(missing, '0') + number);
}

} // namespace tessera::app
