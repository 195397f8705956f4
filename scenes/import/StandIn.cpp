#include "scenes/import/StandIn.h"

#include <array>

namespace tessera::scenes {

Image standInPicture(LoadLedger& ledger, const std::string& who) {
    constexpr int kSquares = 8, kSquareTexels = 8, kSide = kSquares * kSquareTexels;
    using Texel = std::array<std::byte, 4>;
    constexpr Texel kMagenta{std::byte{255}, std::byte{0}, std::byte{255}, std::byte{255}};
    constexpr Texel kGrey{std::byte{40}, std::byte{40}, std::byte{40}, std::byte{255}};
    ledger.charge(kSide * kSide * sizeof(Texel), [&] { return who; });
    Image image;
    image.name = "stand-in for what cannot be read";
    image.width = image.height = kSide;
    image.texels.reserve(kSide * kSide * sizeof(Texel));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Texel& texel = (x / kSquareTexels + y / kSquareTexels) % 2 == 0 ? kMagenta : kGrey;
            image.texels.insert(image.texels.end(), texel.begin(), texel.end());
        }
    return image;
}

} // namespace tessera::scenes
