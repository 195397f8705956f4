#include "base/Names.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/Lowercase.h"

namespace tessera {
namespace {

/// Case-insensitive edit distance: insertions, deletions, replacements and swaps of neighbours from `a` to `b`.
/// Source: Damerau 1964, "A technique for computer detection and correction of spelling errors", in the variant that
/// edits no substring twice (optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> beforeLast(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(beforeLast, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = inLowercase(a[i - 1]) == inLowercase(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && inLowercase(a[i - 1]) == inLowercase(b[j - 2]) &&
                                 inLowercase(a[i - 2]) == inLowercase(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string quotedAlternatives(const std::vector<std::string_view>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text.append("'").append(names[i]).append("'");
    }
    return text;
}

} // namespace

std::vector<std::string_view> nearestNames(std::string_view name, std::span<const std::string_view> candidates) {
    constexpr std::size_t kMostSuggestions = 3;   // more would be a list, not a suggestion
    constexpr std::size_t kLongestCompared = 128; // comparing takes the product of both lengths
    std::vector<std::string_view> nearest;
    std::size_t nearestDistance = 0;
    for (const std::string_view candidate : candidates) {
        // Near: at most a third of the letters differ, or one, but never all of them.
        const auto [shortest, longest] = std::minmax({name.size(), candidate.size()});
        const std::size_t farthest = std::max<std::size_t>(1, longest / 3);
        if (longest > kLongestCompared || longest - shortest > farthest) continue;
        const std::size_t distance = editDistance(name, candidate);
        if (distance > farthest || distance >= longest) continue;
        if (nearest.empty() || distance < nearestDistance) {
            nearest.clear();
            nearestDistance = distance;
        }
        if (distance == nearestDistance && nearest.size() < kMostSuggestions) nearest.push_back(candidate);
    }
    // Abbreviations: candidates that begin with the name.
    constexpr std::size_t kShortestCut = 3;
    if (nearestDistance <= 1 && !nearest.empty()) return nearest;
    std::vector<std::string_view> longer;
    for (const std::string_view candidate : candidates)
        if (name.size() >= kShortestCut && longer.size() < kMostSuggestions && startsWithWord(candidate, name))
            longer.push_back(candidate);
    return longer.empty() ? nearest : longer;
}

std::string suggestNames(std::string_view name, std::span<const std::string_view> candidates) {
    const std::vector<std::string_view> nearest = nearestNames(name, candidates);
    if (!nearest.empty()) return "did you mean " + quotedAlternatives(nearest) + "?";
    if (candidates.empty()) return "there are none";

    std::string all = "valid are ";
    constexpr std::size_t kMostListed = 64; // lists the program's tables completely, a large scene's names partly
    const std::size_t listed = std::min(candidates.size(), kMostListed);
    for (std::size_t i = 0; i < listed; ++i) all.append(i > 0 ? ", " : "").append(candidates[i]);
    if (listed < candidates.size()) all += " and " + std::to_string(candidates.size() - listed) + " more";
    return all;
}

} // namespace tessera
