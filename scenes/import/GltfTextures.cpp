#include "scenes/import/GltfTextures.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/GltfUri.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes::gltf {
namespace {

Wrap wrapOf(int code) {
    switch (code) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::ClampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::MirroredRepeat;
    default:
        return Wrap::Repeat;
    }
}

Filter filterOf(int code, Filter otherwise) {
    switch (code) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        return Filter::Nearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        return Filter::Linear;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        return Filter::NearestMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        return Filter::LinearMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        return Filter::NearestMipmapLinear;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
        return Filter::LinearMipmapLinear;
    default:
        return otherwise;
    }
}

Sampler samplerOf(const tinygltf::Model& model, int index) {
    Sampler sampler;
    if (index < 0) return sampler;
    const tinygltf::Sampler& stored = model.samplers[static_cast<std::size_t>(index)];
    sampler.magnification = filterOf(stored.magFilter, sampler.magnification);
    sampler.minification = filterOf(stored.minFilter, sampler.minification);
    sampler.wrapU = wrapOf(stored.wrapS);
    sampler.wrapV = wrapOf(stored.wrapT);
    return sampler;
}

glm::vec2 pairIn(const tinygltf::Value& object, const std::string& name, glm::vec2 otherwise) {
    if (!object.Has(name)) return otherwise;
    const tinygltf::Value& pair = object.Get(name);
    return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

} // namespace

TextureReference referenceIn(const tinygltf::Value& extension, const std::string& name) {
    TextureReference reference;
    if (!extension.Has(name)) return reference;
    const tinygltf::Value& info = extension.Get(name);
    reference.texture = info.Get("index").GetNumberAsInt();
    reference.texCoordSet = static_cast<int>(numberIn(info, "texCoord", 0.0));
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
        reference.transform = &info.Get("extensions").Get("KHR_texture_transform");
    return reference;
}

TextureUse Textures::use(const TextureReference& reference, const std::string& place) {
    TextureUse use;
    if (reference.texture < 0) return use;
    use.texCoordSet = reference.texCoordSet;
    if (reference.transform != nullptr) {
        use.transform.offset = pairIn(*reference.transform, "offset", use.transform.offset);
        use.transform.scale = pairIn(*reference.transform, "scale", use.transform.scale);
        use.transform.rotationRadians = static_cast<float>(numberIn(*reference.transform, "rotation", 0.0));
        use.texCoordSet = static_cast<int>(numberIn(*reference.transform, "texCoord", use.texCoordSet));
    }
    if (use.texCoordSet > 1) {
        context_.warn(
            fmt::format("{}: uses texture coordinate set {}; only 0 and 1 are supported, so the texture is left out",
                        place, use.texCoordSet));
        return {};
    }
    const tinygltf::Texture& texture = context_.document.model.textures[static_cast<std::size_t>(reference.texture)];
    if (texture.source < 0)
        context_.document.fail(fmt::format("/textures/{}", reference.texture),
                               "has no source in a supported format; store it as PNG or JPEG");
    use.sampler = samplerOf(context_.document.model, texture.sampler);
    use.image = image(texture.source);
    return use;
}

int Textures::image(int index) {
    const auto [entry, isNew] = imported_.try_emplace(index, static_cast<int>(context_.scene.images.size()));
    if (isNew) context_.scene.images.push_back(decoded(index));
    return entry->second;
}

Image Textures::decoded(int index) const {
    const Document& document = context_.document;
    const nlohmann::json& stored = document.json["images"][static_cast<std::size_t>(index)];
    const std::string place = fmt::format("/images/{}", index);
    const std::string uri = stored.value("uri", std::string());
    Image image;
    if (const auto view = stored.find("bufferView"); view != stored.end()) {
        image = decodeImage(context_.buffers.view(view->get<int>()), fmt::format("{}: {}", document.file, place),
                            document.ledger);
    } else if (isDataUri(uri)) {
        const std::uint64_t mark = document.ledger.usedBytes();
        document.charge(2 * uri.size(), "images", index);
        std::vector<std::byte> bytes;
        try {
            bytes = decodeDataUri(uri);
        } catch (const InputError& error) {
            document.fail(place, error.what());
        }
        image = decodeImage(bytes, fmt::format("{}: {}", document.file, place), document.ledger);
        document.ledger.settle(mark, image.texels.size());
    } else if (!uri.empty()) {
        try {
            image = readImage(fileOfUri(uri, document.folder), document.ledger);
        } catch (const InputError& error) {
            document.fail(place, error.what());
        }
    } else {
        document.fail(place, "has neither a uri nor a bufferView");
    }
    image.name = stored.value("name", std::string());
    if (image.name.empty()) image.name = uri.empty() || isDataUri(uri) ? fmt::format("image {}", index) : uri;
    return image;
}

} // namespace tessera::scenes::gltf
