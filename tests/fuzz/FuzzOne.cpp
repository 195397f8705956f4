#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

#include <unistd.h>

#include "base/Error.h"
#include "tests/fuzz/Readers.h"

/// libFuzzer's entry point: one program per target, whose reader is TESSERA_FUZZ_READER. Readers take files, so each
/// input is written to a file beside copies of those in tests/fuzz/beside. The folder is private to the process, and in
/// memory where /dev/shm exists.
namespace {

namespace fs = std::filesystem;
using namespace tessera;

class Folder {
public:
    Folder() {
        const fs::path memory("/dev/shm");
        std::error_code failure;
        path_ = (fs::is_directory(memory, failure) ? memory : fs::temp_directory_path()) /
                ("tessera_fuzz_" + std::to_string(getpid()));
        fs::create_directories(path_);
        fs::copy(TESSERA_FUZZ_BESIDE, path_, fs::copy_options::overwrite_existing);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    static const Folder folder;
    static const fs::path file = folder.path() / TESSERA_FUZZ_FILE;
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (stream == nullptr) std::abort();
    const bool isWritten = std::fwrite(bytes, 1, count, stream) == count;
    if (std::fclose(stream) != 0 || !isWritten) std::abort();
    try {
        fuzz::TESSERA_FUZZ_READER(file);
    } catch (const InputError& error) {
        if (*error.what() == '\0') std::abort();
    }
    return 0;
}
