#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/session/OpenScene.h"

namespace tessera::viewer {

/// Keeps the edits of the open scene that are not saved in a file, which is left where the program ends without asking:
/// a scene file "tessera-NAME.json" in a folder of this process. Other windows keep theirs beside it.
class Recovery {
public:
    /// Below a folder that need not be there; none: nothing is kept.
    explicit Recovery(std::optional<std::filesystem::path> folder);

    /// The file that was written last of those that programs which have ended left; none where there is none.
    std::optional<std::filesystem::path> left() const;
    /// Deletes a file that was left.
    static void discard(const std::filesystem::path& file);

    /// Whether keep() has something to do.
    bool isBehind(const OpenScene& open) const;
    /// Writes the edits of a scene, with its environment as it is seen, in the place of what was kept before; only
    /// deletes that where all edits are saved. Throws as saveScene() does, and as making the folder does.
    void keep(const OpenScene& open);
    /// Deletes what was kept: everything is saved, or to be lost.
    void forget();

private:
    struct Kept {
        std::filesystem::path file;
        std::string source;
        std::uint64_t edits = 0;
    };
    std::optional<std::filesystem::path> folder_;
    std::optional<Kept> kept_;
};

} // namespace tessera::viewer
