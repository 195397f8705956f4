#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tessera::shader {

/// The shader files by their path below shaders/, e.g. "lib/reflectance/brdf.glsl": those compiled into the library, or
/// a folder's.
class SourceTree {
public:
    /// The folder named by the environment variable TESSERA_SHADERS if that is set, else the embedded files.
    SourceTree();
    /// A folder's files. Throws InputError when it is no folder.
    explicit SourceTree(std::filesystem::path folder);
    /// The embedded files, regardless of the environment.
    static SourceTree embedded();

    /// A file as it is now (folders are read anew each time, so edits show; so are hooks, by their absolute paths);
    /// none when there is no such file. Throws InputError when it exists and cannot be read.
    std::optional<std::string> read(std::string_view path) const;
    bool isEmbedded() const { return folder_.empty(); }
    /// "embedded shaders" or the folder, for messages.
    std::string describe() const;
    /// Sets the function that checks and rewrites each hook for programs. `prepare` receives the file and its text,
    /// returns the text for programs, and throws InputError for forbidden constructs.
    using PrepareHook = std::function<std::string(const std::string& file, std::string_view text)>;
    void prepareHooks(PrepareHook prepare) { prepareHook_ = std::move(prepare); }
    std::string preparedHook(const std::string& file, std::string text) const {
        return prepareHook_ ? prepareHook_(file, text) : text;
    }
    /// When a file of the folder last changed, so that a viewer knows when to reload; none for embedded files.
    std::optional<std::filesystem::file_time_type> newestChange() const;

private:
    struct Embedded {};
    explicit SourceTree(Embedded) {}
    std::filesystem::path folder_; ///< empty: embedded
    PrepareHook prepareHook_;
};

} // namespace tessera::shader
