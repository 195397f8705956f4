#pragma once
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace tessera::viewer {

/// The letters that the interface shows: at first those of western Europe, and whatever else occurs in texts. A font
/// has tens of thousands, of which a scene needs few.
class Letters {
public:
    /// Adds those of a UTF-8 text. Letters beyond 16 bits, as emoji, cannot be shown and are left out.
    void note(std::string_view text);
    /// Once: whether letters were added.
    bool takeNew();
    /// Whether there are any of Chinese, Japanese or Korean, for which a second font is needed.
    bool hasEastAsian() const;
    /// First and last of each row of letters, from the least on, and a 0: as Dear ImGui takes them.
    std::vector<std::uint16_t> ranges() const;

private:
    std::set<std::uint16_t> more_; ///< than those at first
    bool isNew_ = false;
};

} // namespace tessera::viewer
