#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// Repaired flaws of a model's files: one warning for each kind of repair in a file, with its first place and the
/// number of further ones. A strict load refuses the first flaw.
class Repairs {
public:
    explicit Repairs(bool isStrict) : isStrict_(isStrict) {}

    /// Records a flaw at a line of the file (0: none); `repair` names what is drawn instead. Throws InputError
    /// "file:line: flaw" if strict.
    template <typename... Values>
    void note(const std::string& file, int line, std::string_view repair, fmt::format_string<Values...> flaw,
              Values&&... values) {
        add(file, repair, [&] {
            return fmt::format("{}{}: {}", file, line == 0 ? "" : fmt::format(":{}", line),
                               fmt::format(flaw, std::forward<Values>(values)...));
        });
    }
    /// The same at a place in the file: "file: place: flaw".
    template <typename... Values>
    void note(const std::string& file, std::string_view place, std::string_view repair,
              fmt::format_string<Values...> flaw, Values&&... values) {
        add(file, repair,
            [&] { return fmt::format("{}: {}: {}", file, place, fmt::format(flaw, std::forward<Values>(values)...)); });
    }

    /// Calls `read` and records a flaw that it throws, unless the load is strict or memory does not suffice. Returns
    /// whether there was none. Charged memory stays charged, which bounds the time spent on flawed parts.
    template <typename Read>
    bool attempt(std::string_view repair, Read&& read) {
        try {
            read();
            return true;
        } catch (const MemoryRefused&) {
            throw;
        } catch (const InputError& error) {
            if (isStrict_) throw;
            add({}, repair, [&] { return std::string(error.what()); });
            return false;
        }
    }

    /// The first flaw, "file:line: flaw"; empty if there is none.
    std::string first() const { return kinds_.empty() ? std::string() : kinds_.front().text; }

    std::vector<std::string> warnings() const {
        std::vector<std::string> lines;
        for (const Kind& kind : kinds_)
            lines.push_back(fmt::format("{}; {}{}", kind.text, kind.repair,
                                        kind.count == 1 ? "" : fmt::format(" (and {} more)", kind.count - 1)));
        return lines;
    }

private:
    template <typename Text>
    void add(const std::string& file, std::string_view repair, Text&& text) {
        const auto known =
            std::ranges::find_if(kinds_, [&](const Kind& kind) { return kind.repair == repair && kind.file == file; });
        if (known != kinds_.end()) {
            ++known->count;
            return;
        }
        if (isStrict_) throw InputError(text());
        kinds_.push_back({file, std::string(repair), text()});
    }

    struct Kind {
        std::string file, repair, text;
        std::size_t count = 1;
    };
    bool isStrict_;
    std::vector<Kind> kinds_; ///< few
};

} // namespace tessera::scenes
