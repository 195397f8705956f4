#pragma once
#include <cstdlib>
#include <optional>
#include <string>

namespace tessera::test {

/// Sets TESSERA_ASSETS for one test, or unsets it.
class AssetsFolder {
public:
    explicit AssetsFolder(const char* folder) {
        if (const char* before = std::getenv("TESSERA_ASSETS")) before_ = before;
        set(folder);
    }
    ~AssetsFolder() { set(before_ ? before_->c_str() : nullptr); }
    AssetsFolder(const AssetsFolder&) = delete;
    AssetsFolder& operator=(const AssetsFolder&) = delete;

private:
    static void set(const char* folder) {
        if (folder != nullptr)
            setenv("TESSERA_ASSETS", folder, 1);
        else
            unsetenv("TESSERA_ASSETS");
    }
    std::optional<std::string> before_;
};

} // namespace tessera::test
