#include "tests/viewer/ViewerTest.h"

#include <fmt/format.h>

#include "validation/PictureFile.h"

namespace tessera::test {

std::string ViewerTest::shell(const std::string& script) const {
    const std::string whole = fmt::format("tessera() {{ '{}' \"$@\"; }}\n{}", TESSERA_PROGRAM, script);
    const ProcessResult result = runProcess({"sh", "-c", whole}, {folder_.path(), {}, 120.0});
    EXPECT_EQ(result.exitCode, 0) << script << "\n" << result.err;
    return result.out;
}

Shot ViewerTest::rendered(const std::string& arguments, glm::ivec2 sizePixels) const {
    shell(fmt::format("tessera render {} --size {}x{} -o rendered.png", arguments, sizePixels.x, sizePixels.y));
    return readShot(folder_.path() / "rendered.png");
}

validation::Picture ViewerTest::exr(const std::string& name) const {
    return validation::readPicture((folder_.path() / name).string());
}

} // namespace tessera::test
