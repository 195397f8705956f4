#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tessera::shader {

/// Shader files by their path below shaders/, e.g. "lib/reflectance/brdf.glsl": embedded in the library, or read from a
/// folder.
class SourceTree {
public:
    /// The folder named by the environment variable TESSERA_SHADERS if that is set, else the embedded files.
    SourceTree();
    /// A folder's files. Throws InputError when it is no folder.
    explicit SourceTree(std::filesystem::path folder);
    /// The embedded files, regardless of the environment.
    static SourceTree embedded();

    /// Reads a file; none if it does not exist. Files of folders, and hooks by their absolute paths, are read anew each
    /// time, so edits take effect. Throws InputError if an existing file cannot be read.
    std::optional<std::string> read(std::string_view path) const;
    bool isEmbedded() const { return folder_.empty(); }
    /// "the embedded shaders" or the folder, for messages.
    std::string describe() const;
    /// Sets the function that checks and rewrites each hook for programs. `prepare` receives the file and its text,
    /// returns the text for programs, and throws InputError for forbidden constructs.
    using PrepareHook = std::function<std::string(const std::string& file, std::string_view text)>;
    void prepareHooks(PrepareHook prepare) { prepareHook_ = std::move(prepare); }
    std::string preparedHook(const std::string& file, std::string text) const {
        return prepareHook_ ? prepareHook_(file, text) : text;
    }
    /// Time of the last change in the folder, for viewers that reload; none for embedded files.
    std::optional<std::filesystem::file_time_type> newestChange() const;

private:
    struct Embedded {};
    explicit SourceTree(Embedded) {}
    std::filesystem::path folder_; ///< empty: embedded
    PrepareHook prepareHook_;
};

} // namespace tessera::shader
