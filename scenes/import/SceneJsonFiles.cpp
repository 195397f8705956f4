#include "scenes/import/SceneJsonParts.h"

#include <cstdlib>
#include <system_error>

#include <glm/trigonometric.hpp>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "scenes/import/SceneJsonNames.h"

namespace tessera::scenes::scenejson {
namespace {

TextureTransform readTextureTransform(const JsonValue& value) {
    JsonObject object = value.object();
    TextureTransform transform;
    if (const auto offset = object.find("offset")) transform.offset = offset->vector2();
    if (const auto scale = object.find("scale")) transform.scale = scale->vector2();
    if (const auto rotation = object.find("rotationDegrees"))
        transform.rotationRadians = glm::radians(rotation->single());
    object.done("a texture transform");
    return transform;
}

Sampler readSampler(const JsonValue& value) {
    JsonObject object = value.object();
    Sampler sampler;
    if (const auto filter = object.find("magFilter"))
        sampler.magnification = filter->oneOf<Filter>("magnification filter", std::span(kFilters).first<2>());
    if (const auto filter = object.find("minFilter"))
        sampler.minification = filter->oneOf<Filter>("minification filter", kFilters);
    if (const auto wrap = object.find("wrapU")) sampler.wrapU = wrap->oneOf<Wrap>("wrap mode", kWraps);
    if (const auto wrap = object.find("wrapV")) sampler.wrapV = wrap->oneOf<Wrap>("wrap mode", kWraps);
    object.done("a sampler");
    return sampler;
}

} // namespace

std::filesystem::path resolveFile(const JsonValue& name) {
    constexpr std::string_view kVariable = "${TESSERA_ASSETS}";
    std::string text = name.text();
    if (const std::size_t at = text.find(kVariable); at != std::string::npos) {
        const char* folder = std::getenv("TESSERA_ASSETS");
        if (folder == nullptr || *folder == '\0')
            name.fail("needs the environment variable TESSERA_ASSETS, which is not set; set it to the folder of the "
                      "third-party models");
        text.replace(at, kVariable.size(), folder);
    }
    if (text.find("${") != std::string::npos)
        name.fail("'{}': only ${{TESSERA_ASSETS}} is replaced in file names, once", name.text());
    const std::filesystem::path file = name.file().parent_path() / text;
    std::error_code failure;
    if (!std::filesystem::exists(file, failure))
        name.fail("there is no file '{}'; names are relative to the document's folder", file.string());
    return file;
}

int Images::image(const JsonValue& fileName) {
    if (scene_ == nullptr)
        fileName.fail("names a file where only pictures of the base can be used; give the number of one as 'image'");
    const std::filesystem::path file = resolveFile(fileName);
    const auto [entry, isNew] = imageOfFile_.try_emplace(file.lexically_normal().string(), kNone);
    if (!isNew) return entry->second;
    try {
        scene_->images.push_back(readImage(file, *ledger_));
    } catch (const InputError& error) {
        fileName.fail(error.what());
    }
    return entry->second = static_cast<int>(scene_->images.size()) - 1;
}

int Images::baseImage(const JsonValue& index) const {
    if (baseImages_ == 0) index.fail("there is no picture of a base; name a 'file'");
    return index.integer(0, static_cast<int>(baseImages_) - 1);
}

TextureUse readTexture(const JsonValue& value, Images& images) {
    if (value.isText()) {
        TextureUse use;
        use.image = images.image(value);
        return use;
    }
    JsonObject object = value.object();
    const TextureUse use = readTexture(object, images);
    object.done("a texture");
    return use;
}

TextureUse readTexture(JsonObject& object, Images& images) {
    TextureUse use;
    const std::optional<JsonValue> image = object.find("image");
    const std::optional<JsonValue> file = image ? object.find("file") : object.require("file");
    if (image && file) file->fail("is given beside 'image'; keep one");
    if (const auto set = object.find("texCoord")) use.texCoordSet = set->integer(0, 1);
    if (const auto transform = object.find("transform")) use.transform = readTextureTransform(*transform);
    if (const auto sampler = object.find("sampler")) use.sampler = readSampler(*sampler);
    // Last: a picture takes long to read, and the rest may be wrong.
    use.image = image ? images.baseImage(*image) : images.image(*file);
    return use;
}

} // namespace tessera::scenes::scenejson
