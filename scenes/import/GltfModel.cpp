#include "scenes/import/GltfModel.h"

namespace tessera::scenes::gltf::model {
namespace {

constexpr IndexOf kLights{"extensions/KHR_lights_punctual/lights"};
constexpr IndexOf kImageLights{"extensions/EXT_lights_image_based/lights"};
constexpr IndexOf kVariants{"extensions/KHR_materials_variants/variants"};
constexpr Range kInts{0.0, kMaxInt};

constexpr Choice<int, ComponentType> kComponentTypes[] = {
    {5120, ComponentType::Byte},          {5121, ComponentType::UnsignedByte}, {5122, ComponentType::Short},
    {5123, ComponentType::UnsignedShort}, {5125, ComponentType::UnsignedInt},  {5126, ComponentType::Float}};
constexpr Choice<int, ComponentType> kIndexTypes[] = {
    {5121, ComponentType::UnsignedByte}, {5123, ComponentType::UnsignedShort}, {5125, ComponentType::UnsignedInt}};
constexpr Choice<std::string_view, int> kComponents[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                         {"MAT2", 0},   {"MAT3", 0}, {"MAT4", 16}};
constexpr Choice<std::string_view, std::string_view> kModes[] = {
    {"ATTRIBUTES", "ATTRIBUTES"}, {"TRIANGLES", "TRIANGLES"}, {"INDICES", "INDICES"}};
constexpr Choice<std::string_view, std::string_view> kFilters[] = {
    {"NONE", "NONE"}, {"OCTAHEDRAL", "OCTAHEDRAL"}, {"QUATERNION", "QUATERNION"}, {"EXPONENTIAL", "EXPONENTIAL"}};
constexpr Choice<int, Filter> kMagnifications[] = {{9728, Filter::Nearest}, {9729, Filter::Linear}};
constexpr Choice<int, Filter> kMinifications[] = {{9728, Filter::Nearest},
                                                  {9729, Filter::Linear},
                                                  {9984, Filter::NearestMipmapNearest},
                                                  {9985, Filter::LinearMipmapNearest},
                                                  {9986, Filter::NearestMipmapLinear},
                                                  {9987, Filter::LinearMipmapLinear}};
constexpr Choice<int, Wrap> kWraps[] = {
    {33071, Wrap::ClampToEdge}, {33648, Wrap::MirroredRepeat}, {10497, Wrap::Repeat}};
constexpr Choice<std::string_view, AlphaMode> kAlphaModes[] = {
    {"OPAQUE", AlphaMode::Opaque}, {"MASK", AlphaMode::Mask}, {"BLEND", AlphaMode::Blend}};
constexpr Choice<std::string_view, Interpolation> kInterpolations[] = {
    {"LINEAR", Interpolation::Linear}, {"STEP", Interpolation::Step}, {"CUBICSPLINE", Interpolation::CubicSpline}};
constexpr Choice<std::string_view, Projection> kProjections[] = {{"perspective", Projection::Perspective},
                                                                 {"orthographic", Projection::Orthographic}};
constexpr Choice<std::string_view, LightType> kLightTypes[] = {
    {"directional", LightType::Directional}, {"point", LightType::Point}, {"spot", LightType::Spot}};

} // namespace

// Source of names, ranges and defaults: glTF 2.0 specification, section 5, and the extensions' README schemas.

void Model::read(Object& object) {
    object.required("asset/version", unneeded<std::string>());
    object.optional("asset/minVersion", unneeded<std::string>());
    object.optional("asset/generator", generator);
    object.optional("extensionsUsed", extensionsUsed);
    object.optional("extensionsRequired", extensionsRequired);
    object.required(kLights.array, lights);
    object.required(kImageLights.array, imageLights);
    object.optional("scene", scene, IndexOf{"scenes"});
    object.optional("scenes", scenes);
    object.optional("nodes", nodes);
    object.optional("meshes", meshes);
    object.optional("accessors", accessors);
    object.optional("bufferViews", bufferViews);
    object.optional("buffers", buffers);
    object.optional("images", images);
    object.optional("textures", textures);
    object.optional("samplers", samplers);
    object.optional("materials", materials);
    object.optional("cameras", cameras);
    object.optional("skins", skins);
    object.optional("animations", animations);
    object.optional(kVariants.array, variants);
}

void Variant::read(Object& object) {
    object.required("name", name);
}

void Scene::read(Object& object) {
    object.optional("name", unneeded<std::string>());
    object.optional("nodes", nodes, IndexOf{"nodes"});
    object.required("extensions/EXT_lights_image_based/light", imageLight, kImageLights);
}

void Node::read(Object& object) {
    object.optional("name", name);
    object.optional("children", children, IndexOf{"nodes"});
    object.optional("mesh", mesh, IndexOf{"meshes"});
    object.optional("camera", camera, IndexOf{"cameras"});
    object.optional("skin", skin, IndexOf{"skins"});
    object.optional("weights", weights);
    object.optional("matrix", matrix);
    object.optional("translation", translation);
    object.optional("rotation", rotation);
    object.optional("scale", scale);
    object.required("extensions/KHR_lights_punctual/light", light, kLights);
    object.required("extensions/EXT_mesh_gpu_instancing/attributes", instanceAttributes, IndexOf{"accessors"});
}

// ---- Geometry ------------------------------------------------------------------------------------------------------

void Mesh::read(Object& object) {
    object.optional("name", name);
    object.required("primitives", primitives);
    object.optional("weights", weights);
}

void Primitive::read(Object& object) {
    object.required("attributes", attributes, IndexOf{"accessors"});
    object.optional("indices", indices, IndexOf{"accessors"});
    object.optional("material", material, IndexOf{"materials"});
    object.optional("mode", mode, Range{0.0, 6.0});
    object.optional("targets", targets, IndexOf{"accessors"});
    object.optional("extensions", unneeded<AnyObject>());
    object.optional("extensions/KHR_materials_variants/mappings", variantMappings);
    object.optional("extensions/KHR_draco_mesh_compression", draco);
}

void Draco::read(Object& object) {
    object.required("bufferView", bufferView, IndexOf{"bufferViews"});
    object.required("attributes", attributes, kInts);
}

void VariantMapping::read(Object& object) {
    object.required("material", material, IndexOf{"materials"});
    object.required("variants", variants, kVariants);
}

void Accessor::read(Object& object) {
    object.optional("name", unneeded<std::string>());
    object.optional("bufferView", bufferView, IndexOf{"bufferViews"});
    object.optional("byteOffset", byteOffset, kBytes);
    object.required("componentType", componentType, kComponentTypes);
    object.required("count", count, kCount);
    object.required("type", components, kComponents);
    object.optional("normalized", normalized);
    object.optional("sparse", sparse);
}

void Sparse::read(Object& object) {
    object.required("count", count, Range{1.0, kMaxInt});
    object.required("indices", unneeded<AnyObject>());
    object.required("indices/bufferView", indicesView, IndexOf{"bufferViews"});
    object.optional("indices/byteOffset", indicesOffset, kInts);
    object.required("indices/componentType", indexType, kIndexTypes);
    object.required("values", unneeded<AnyObject>());
    object.required("values/bufferView", valuesView, IndexOf{"bufferViews"});
    object.optional("values/byteOffset", valuesOffset, kInts);
}

void Buffer::read(Object& object) {
    object.required("byteLength", byteLength, kCount);
    object.optional("uri", uri);
}

void Slice::read(Object& object) {
    object.required("buffer", buffer, IndexOf{"buffers"});
    object.optional("byteOffset", byteOffset, kBytes);
    object.required("byteLength", byteLength, kCount);
}

void BufferView::read(Object& object) {
    bytes.read(object);
    object.optional("byteStride", byteStride, Range{4.0, 252.0});
    if (byteStride % 4 != 0) object.fail("byteStride", fmt::format("is {}; it must be a multiple of 4", byteStride));
    object.optional("extensions/EXT_meshopt_compression", meshopt);
}

void Meshopt::read(Object& object) {
    encoded.read(object);
    object.required("byteStride", byteStride, Range{1.0, 256.0});
    object.required("count", count, kCount);
    object.required("mode", mode, kModes);
    object.optional("filter", filter, kFilters);
}

// ---- Materials -----------------------------------------------------------------------------------------------------

void Image::read(Object& object) {
    object.optional("name", name);
    object.optional("uri", uri);
    object.optional("bufferView", bufferView, IndexOf{"bufferViews"});
    object.optional("mimeType", unneeded<std::string>());
}

void Texture::read(Object& object) {
    object.optional("name", unneeded<std::string>());
    object.optional("source", source, IndexOf{"images"});
    object.required("extensions/EXT_texture_webp/source", webp, IndexOf{"images"});
    object.optional("sampler", sampler, IndexOf{"samplers"});
}

void Sampler::read(Object& object) {
    object.optional("magFilter", magnification, kMagnifications);
    object.optional("minFilter", minification, kMinifications);
    object.optional("wrapS", wrapU, kWraps);
    object.optional("wrapT", wrapV, kWraps);
}

void TextureInfo::read(Object& object) {
    object.required("index", texture, IndexOf{"textures"});
    object.optional("texCoord", texCoordSet, kInts);
    object.optional("extensions/KHR_texture_transform/offset", transform.offset);
    object.optional("extensions/KHR_texture_transform/scale", transform.scale);
    object.optional("extensions/KHR_texture_transform/rotation", transform.rotationRadians);
    object.optional("extensions/KHR_texture_transform/texCoord", texCoordSet, kInts);
}

void SpecularGlossiness::read(Object& object) {
    object.optional("diffuseFactor", diffuse, kFraction);
    object.optional("specularFactor", specular, kFraction);
    object.optional("glossinessFactor", glossiness, kFraction);
    object.optional("diffuseTexture", diffuseTexture);
    object.optional("specularGlossinessTexture", specularGlossinessTexture);
}

void Material::read(Object& object) {
    object.optional("name", surface.name);
    object.optional("pbrMetallicRoughness/baseColorFactor", surface.baseColor, kFromZero);
    object.optional("pbrMetallicRoughness/metallicFactor", surface.metallic, kFraction);
    object.optional("pbrMetallicRoughness/roughnessFactor", surface.perceptualRoughness, kFraction);
    object.optional("normalTexture/scale", surface.normalScale);
    object.optional("occlusionTexture/strength", surface.occlusionStrength, kFraction);
    object.optional("alphaMode", surface.alphaMode, kAlphaModes);
    object.optional("alphaCutoff", surface.alphaCutoff, kFromZero);
    object.optional("doubleSided", surface.doubleSided);
    for (std::size_t i = 0; i < textures.size(); ++i) object.optional(kTexturePlaces[i].path, textures[i]);

    std::optional<AnyObject> unlit;
    object.optional("extensions/KHR_materials_unlit", unlit);
    if (unlit) surface.model = MaterialModel::SingleColor;
    if (!unlit) object.optional("extensions/KHR_materials_pbrSpecularGlossiness", specularGlossiness);
    // An unlit material is its base colour; the rest is a fallback for programs that do not know the extension.
    scenes::Material unneededLayers;
    scenes::Material& layers = unlit ? unneededLayers : surface;
    object.optional("emissiveFactor", layers.emissive, kFromZero);
    object.optional("extensions/KHR_materials_emissive_strength/emissiveStrength", emissiveStrength, kFromZero);
    emissiveFactor = layers.emissive;
    layers.emissive *= emissiveStrength;
    object.optional("extensions/KHR_materials_ior/ior", ior, kFromZero);
    object.optional("extensions/KHR_materials_specular/specularFactor", layers.specularFactor, kFraction);
    object.optional("extensions/KHR_materials_specular/specularColorFactor", layers.specularColor, kFromZero);
    object.optional("extensions/KHR_materials_anisotropy/anisotropyStrength", layers.anisotropyStrength, kFraction);
    object.optional("extensions/KHR_materials_anisotropy/anisotropyRotation", layers.anisotropyRotationRadians);
    object.optional("extensions/KHR_materials_clearcoat/clearcoatFactor", layers.clearcoat, kFraction);
    object.optional("extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", layers.clearcoatPerceptualRoughness,
                    kFraction);
    object.optional("extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", layers.clearcoatNormalScale);
    object.optional("extensions/KHR_materials_sheen/sheenColorFactor", layers.sheenColor, kFraction);
    object.optional("extensions/KHR_materials_sheen/sheenRoughnessFactor", layers.sheenPerceptualRoughness, kFraction);
    object.optional("extensions/KHR_materials_iridescence/iridescenceFactor", layers.iridescence, kFraction);
    object.optional("extensions/KHR_materials_iridescence/iridescenceIor", layers.iridescenceIor, kFromOne);
    object.optional("extensions/KHR_materials_iridescence/iridescenceThicknessMinimum",
                    layers.iridescenceLeastThicknessNm, kFromZero);
    object.optional("extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", layers.iridescenceThicknessNm,
                    kFromZero);
    object.optional("extensions/KHR_materials_transmission/transmissionFactor", layers.transmission, kFraction);
    object.optional("extensions/KHR_materials_volume/thicknessFactor", layers.thicknessMetres, kFromZero);
    object.optional("extensions/KHR_materials_volume/attenuationColor", layers.attenuationColor, kFraction);
    object.optional("extensions/KHR_materials_dispersion/dispersion", layers.dispersion, kFromZero);
    constexpr std::string_view kDistance = "extensions/KHR_materials_volume/attenuationDistance";
    std::optional<float> distance; // infinity, which 0 stands for in a scene
    object.optional(kDistance, distance, kFromZero);
    if (distance && *distance == 0.0f) object.fail(kDistance, "is 0; more than 0 is needed");
    layers.attenuationDistanceMetres = distance.value_or(0.0f);
}

// ---- Animation -----------------------------------------------------------------------------------------------------

void Skin::read(Object& object) {
    object.optional("name", name);
    object.optional("inverseBindMatrices", inverseBindMatrices, IndexOf{"accessors"});
    object.optional("skeleton", unneeded<int>(), IndexOf{"nodes"});
    object.required("joints", joints, IndexOf{"nodes"});
}

void AnimationSampler::read(Object& object) {
    object.required("input", input, IndexOf{"accessors"});
    object.required("output", output, IndexOf{"accessors"});
    object.optional("interpolation", interpolation, kInterpolations);
}

void AnimationChannel::read(Object& object) {
    object.required("sampler", sampler, kInts);
    object.required("target", unneeded<AnyObject>());
    object.required("target/path", path);
    object.optional("target/node", node, IndexOf{"nodes"});
    object.optional("target/extensions/KHR_animation_pointer/pointer", pointer);
}

void Animation::read(Object& object) {
    object.optional("name", name);
    object.required("samplers", samplers);
    object.required("channels", channels);
    for (const AnimationChannel& channel : channels)
        if (static_cast<std::size_t>(channel.sampler) >= samplers.size())
            object.fail("channels",
                        fmt::format("names sampler {}, but there are only {}", channel.sampler, samplers.size()));
}

// ---- Cameras and lights --------------------------------------------------------------------------------------------

void Camera::read(Object& object) {
    object.optional("name", name);
    object.required("type", projection, kProjections);
    object.required("perspective/yfov", perspective.yfov);
    object.required("perspective/znear", perspective.znear);
    object.optional("perspective/zfar", perspective.zfar);
    object.required("orthographic/xmag", orthographic.xmag);
    object.required("orthographic/ymag", orthographic.ymag);
    object.required("orthographic/znear", orthographic.znear);
    object.required("orthographic/zfar", orthographic.zfar);
    const std::string_view lens = projection == Projection::Perspective ? "perspective" : "orthographic";
    if (!object.has(lens)) object.failMissing(lens);
}

void Light::read(Object& object) {
    object.optional("name", name);
    object.required("type", type, kLightTypes);
    object.optional("color", color, kFromZero);
    object.optional("intensity", intensity, kFromZero);
    object.optional("range", range, kFromZero);
    object.optional("spot/innerConeAngle", innerConeAngle, kFromZero);
    object.optional("spot/outerConeAngle", outerConeAngle, kFromZero);
    if (type == LightType::Spot && !object.has("spot")) object.failMissing("spot");
}

void ImageLight::read(Object& object) {
    constexpr std::size_t kCoefficients = 9, kFaces = 6;
    object.optional("name", name);
    object.optional("intensity", intensity, kFromZero);
    object.optional("rotation", rotation);
    object.required("irradianceCoefficients", irradiance);
    object.required("specularImages", images, IndexOf{"images"});
    object.required("specularImageSize", sideTexels, Range{1.0, kMaxInt});
    if (glm::dot(rotation, rotation) == 0.0) object.fail("rotation", "is the zero quaternion, which is no rotation");
    if (irradiance.size() != kCoefficients)
        object.fail("irradianceCoefficients",
                    fmt::format("must hold {} colours, but holds {}", kCoefficients, irradiance.size()));
    if (images.empty()) object.fail("specularImages", "is empty; the six faces of a cube are needed");
    for (const std::vector<int>& faces : images)
        if (faces.size() != kFaces)
            object.fail("specularImages", fmt::format("must hold {} faces of a cube in each element, but one holds {}",
                                                      kFaces, faces.size()));
}

} // namespace tessera::scenes::gltf::model
