#include "renderer/shader/Preprocess.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/shader/Conditionals.h"
#include "renderer/shader/LineScanner.h"
#include "renderer/shader/ShaderPath.h"

namespace tessera::shader {
namespace {

struct File {
    std::string path;
    std::vector<std::string> lines;
    bool once = false;
};

std::vector<std::string> splitLines(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        lines.emplace_back(line);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

bool hasPragmaOnce(const std::vector<std::string>& lines) {
    LineScanner scanner;
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        const Directive directive = scanner.next(line);
        return directive.name == "pragma" && directive.arguments == "once";
    });
}

class Expander {
public:
    Expander(const SourceTree& tree, const Defines& defines) : tree_(tree) {
        result_.text = "#version 450 core\n";
        for (const auto& [name, value] : defines) {
            if (name == kHookFile)
                hookFile_ = value;
            else if (name == kHookParameters)
                hookParameters_ = value;
            else
                result_.text +=
                    value.empty() ? fmt::format("#define {}\n", name) : fmt::format("#define {} {}\n", name, value);
        }
    }

    ExpandedSource run(std::string_view entryPath) {
        const std::optional<std::size_t> entry = load(std::string(entryPath));
        if (!entry)
            throw InputError(fmt::format("{}: no such file in {}; correct the name of the program's stage",
                                         displayPath(entryPath), tree_.describe()));
        emit(*entry, false);
        if (!hookFile_.empty() && indexOf_.contains(std::string(kHookInterface))) emitHook();
        return std::move(result_);
    }

private:
    /// Index of a file, read on first use; none if it does not exist.
    std::optional<std::size_t> load(const std::string& path) {
        if (const auto known = indexOf_.find(path); known != indexOf_.end()) return known->second;
        const std::optional<std::string> text = tree_.read(path);
        if (!text) return std::nullopt;
        File& file = files_.emplace_back(File{path, splitLines(*text)});
        file.once = hasPragmaOnce(file.lines);
        result_.files.push_back(path);
        return indexOf_[path] = files_.size() - 1;
    }

    static std::string lineDirective(std::size_t line, std::size_t fileIndex) {
        return fmt::format("#line {} {}\n", fileIndex * kLinesAFile + line, fileIndex);
    }

    void emit(std::size_t index, bool conditional) {
        stack_.push_back(index);
        // Copied, since loading further files may reallocate the list.
        const File file = files_[index];
        result_.text += lineDirective(1, index);
        LineScanner scanner;
        Conditionals conditionals;
        for (std::size_t i = 0; i < file.lines.size(); ++i) {
            const Place place{file.path, i + 1};
            const Directive directive = scanner.next(file.lines[i]);
            conditionals.follow(directive);
            if (directive.name == "include") {
                if (scanner.isOpen()) fail(place, "the #include must end on its line; so must a comment after it");
                if (!conditionals.inCpp()) include(directive.arguments, place, conditional || conditionals.depth() > 0);
                result_.text += conditionals.inCpp() ? "\n" : lineDirective(place.line + 1, index);
            } else if (directive.name == "pragma" && directive.arguments == "once") {
                result_.text += '\n';
            } else if (directive.name == "version") {
                if (directive.arguments != "450 core" && directive.arguments != "450")
                    fail(place, "every shader is '#version 450 core'; leave the #version out");
                result_.text += '\n';
            } else {
                result_.text += file.lines[i] + '\n';
            }
        }
        stack_.pop_back();
    }

    /// Appends the hook after all other source, where its definitions cannot change the program.
    void emitHook() {
        const std::optional<std::size_t> hook = load(hookFile_);
        if (!hook)
            throw InputError(fmt::format("{}: the scene's hook is not there any more; bring it back, or load the scene "
                                         "again",
                                         hookFile_));
        std::string text;
        for (const std::string& line : files_[*hook].lines) text += line + '\n';
        // An edit may have followed the load of the scene, so the hook is checked again, except the built-in empty one.
        if (std::filesystem::path(hookFile_).is_absolute()) text = tree_.preparedHook(hookFile_, std::move(text));
        // Names the block in driver errors, e.g. about a parameter with the name of a GLSL keyword.
        result_.files.push_back(hookFile_ + " (its parameters)");
        result_.text += "#if HOOKED\n" + lineDirective(1, result_.files.size() - 1);
        result_.text += "layout(std140, binding = UNIFORM_HOOK) uniform HookBlock\n{\n    float timeSeconds;\n";
        std::istringstream parameters(hookParameters_);
        for (std::string name; parameters >> name;) result_.text += fmt::format("    float {};\n", name);
        result_.text += "} hook;\n" + lineDirective(1, *hook) + text + "#endif\n";
    }

    struct Place {
        const std::string& file;
        std::size_t line; ///< from 1
    };

    [[noreturn]] void fail(const Place& place, const std::string& what) const {
        throw InputError(fmt::format("{}:{}: {}", displayPath(place.file), place.line, what));
    }

    void include(const std::string& argument, const Place& place, bool conditional) {
        if (argument.size() < 3 || argument.front() != '"' || argument.find('"', 1) != argument.size() - 1)
            fail(place, fmt::format("malformed #include {}; write #include \"lib/file.glsl\"", argument));
        const std::string wanted = argument.substr(1, argument.size() - 2);
        const std::optional<std::size_t> found = resolve(wanted, place.file);
        if (!found)
            fail(place,
                 fmt::format("cannot include '{}': no such file below shaders/ or beside the including file, in {}",
                             wanted, tree_.describe()));
        if (const auto at = std::find(stack_.begin(), stack_.end(), *found); at != stack_.end())
            fail(place, fmt::format("the #include of '{}' closes a cycle: {}; move what both need to a third file",
                                    files_[*found].path, chain(at, *found)));
        if (!files_[*found].once) return emit(*found, conditional);
        // The file is omitted if an earlier copy is active under all conditionals. If only the driver can evaluate the
        // conditionals around that copy, a guard lets the driver decide.
        if (certain_.contains(*found)) return;
        const bool guarded = conditional || possible_.contains(*found);
        if (guarded) result_.text += fmt::format("#ifndef TESSERA_ONCE_{0}\n#define TESSERA_ONCE_{0}\n", *found);
        (conditional ? possible_ : certain_).insert(*found);
        emit(*found, conditional);
        if (guarded) result_.text += "#endif\n";
    }

    std::optional<std::size_t> resolve(const std::string& wanted, const std::string& including) {
        for (const std::string& path : includeCandidates(wanted, including))
            if (const std::optional<std::size_t> found = load(path)) return found;
        return std::nullopt;
    }

    std::string chain(std::vector<std::size_t>::const_iterator from, std::size_t closing) const {
        std::string text;
        for (auto at = from; at != stack_.end(); ++at) text += files_[*at].path + " -> ";
        return text + files_[closing].path;
    }

    const SourceTree& tree_;
    ExpandedSource result_;
    std::string hookFile_, hookParameters_; ///< empty: none
    std::vector<File> files_;
    std::map<std::string, std::size_t> indexOf_;
    std::vector<std::size_t> stack_; ///< files being expanded, the entry first
    std::set<std::size_t> certain_;  ///< #pragma once files included outside of conditionals
    std::set<std::size_t> possible_; ///< those included inside a conditional
};

} // namespace

ExpandedSource expand(const SourceTree& tree, std::string_view entryPath, const Defines& defines) {
    return Expander(tree, defines).run(entryPath);
}

} // namespace tessera::shader
