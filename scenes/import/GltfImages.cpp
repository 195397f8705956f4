#include "scenes/import/GltfImages.h"

#include <utility>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/GltfUri.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes::gltf {
namespace {

/// Of memory, that pictures which cannot be read take one after the other. Each takes the time of one that can be read,
/// and any number of them may name one file or one buffer; of those that can be read the ledger bounds the number.
constexpr std::uint64_t kMostUnreadableBytes = std::uint64_t{1} << 32;

Image decoded(const Context& context, int index) {
    const Document& document = context.document;
    const tiny::Image& stored = elementAt(document.model.images, index);
    const std::string& uri = stored.uri;
    const std::string place = fmt::format("/images/{}", index);
    Image image;
    if (stored.bufferView != kNone) {
        image = decodeImage(context.buffers.view(stored.bufferView), fmt::format("{}: {}", document.file, place),
                            document.ledger);
    } else if (isDataUri(uri)) {
        const std::uint64_t mark = document.ledger.usedBytes();
        document.charge(2 * uri.size(), "images", index);
        std::vector<std::byte> bytes;
        try {
            bytes = decodeDataUri(uri);
        } catch (const InputError& error) {
            document.fail(place, error);
        }
        image = decodeImage(bytes, fmt::format("{}: {}", document.file, place), document.ledger);
        document.ledger.settle(mark, image.texels.size());
    } else if (!uri.empty()) {
        const std::filesystem::path file = document.fileAt(place, uri);
        try {
            image = readImage(file, document.ledger);
        } catch (const InputError& error) {
            document.fail(place, error);
        }
    } else {
        document.fail(place, "has neither a uri nor a bufferView");
    }
    image.name = stored.name;
    if (image.name.empty()) image.name = uri.empty() || isDataUri(uri) ? fmt::format("image {}", index) : uri;
    return image;
}

} // namespace

std::optional<Image> readableImage(Context& context, int index, const char* instead) {
    const Document& document = context.document;
    const std::uint64_t mark = document.ledger.usedBytes() - context.buffers.heldBytes();
    try {
        return decoded(context, index);
    } catch (const MemoryRefused&) {
        throw;
    } catch (const InputError& error) {
        if (document.ledger.wishes().isStrict) throw;
        context.unreadableBytes += document.ledger.usedBytes() - context.buffers.heldBytes() - mark;
        if (context.unreadableBytes > kMostUnreadableBytes)
            document.fail(fmt::format("/images/{}", index),
                          fmt::format("the pictures up to here that cannot be read took {} of memory, and {} at most "
                                      "are spent on them; mend the model's pictures, or take them out",
                                      sizeText(context.unreadableBytes), sizeText(kMostUnreadableBytes)));
        document.ledger.settle(mark, context.buffers.heldBytes());
        const std::string text = error.what(), file = document.file + ": "; // which warn() names itself
        context.warn(text.substr(text.starts_with(file) ? file.size() : 0) + instead);
        return std::nullopt;
    }
}

} // namespace tessera::scenes::gltf
