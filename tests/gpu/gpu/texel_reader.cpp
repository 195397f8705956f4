#include "renderer/gpu/TexelReader.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

#include "renderer/gpu/Commands.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

class TexelReaderTest : public test::GlTest {};

template <typename T>
std::vector<T> valuesOf(const TexelReader::Texel& texel, std::size_t count) {
    std::vector<T> values(count);
    std::memcpy(values.data(), texel.data(), count * sizeof(T));
    return values;
}

TEST_F(TexelReaderTest, aTexelOfEachTextureComesAsItIsStored) {
    const Texture radiance("radiance", {graph::Format::Rgba32Float, 3, 2, 1});
    const Texture display("display", {graph::Format::Rgba8Unorm, 3, 2, 1});
    std::vector<float> floats(24);
    std::iota(floats.begin(), floats.end(), 0.25f);
    std::vector<std::uint8_t> bytes(24);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t(100));
    radiance.upload(0, floats);
    display.upload(0, bytes);
    TexelReader reader;
    EXPECT_FALSE(reader.isBusy());
    EXPECT_FALSE(reader.take());
    const std::array<const Texture*, 2> textures{&radiance, &display};
    reader.request(textures, {0, 0}); // replaced by the next request
    reader.request(textures, {1, 1});
    EXPECT_TRUE(reader.isBusy());
    finish();
    const auto texels = reader.take();
    ASSERT_TRUE(texels);
    ASSERT_EQ(texels->size(), 2u);
    EXPECT_THAT(valuesOf<float>((*texels)[0], 4), testing::ElementsAre(16.25f, 17.25f, 18.25f, 19.25f));
    EXPECT_THAT(valuesOf<std::uint8_t>((*texels)[1], 4), testing::ElementsAre(116, 117, 118, 119));
    EXPECT_FALSE(reader.isBusy());
    EXPECT_FALSE(reader.take()) << "it is taken once";
}

} // namespace
} // namespace tessera::gpu
