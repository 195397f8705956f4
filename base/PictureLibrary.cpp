#include "base/PictureLibrary.h"

#include <stdexcept>

#include <dlfcn.h>
#include <fmt/format.h>

namespace tessera {

PictureLibrary& PictureLibrary::get() {
    // Found by the program's run path; never unloaded.
    static PictureLibrary* const library = [] {
        void* const module = dlopen(TESSERA_PICTURE_MODULE, RTLD_NOW | RTLD_LOCAL);
        void* const make = module != nullptr ? dlsym(module, kMakePictureLibrary) : nullptr;
        if (make == nullptr)
            throw std::runtime_error(fmt::format("pictures cannot be read or written: {}; install Tessera again, or "
                                                 "name the folder of {} in LD_LIBRARY_PATH",
                                                 dlerror(), TESSERA_PICTURE_MODULE));
        return reinterpret_cast<MakePictureLibrary*>(make)();
    }();
    return *library;
}

} // namespace tessera
