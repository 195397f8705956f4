#include "viewer/panels/Meanings.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

struct Meaning {
    std::string_view label;
    std::string_view meaning;
};

constexpr Meaning kMeanings[] = {
    // Scene
    {"Scene", "The scene that is shown: a built-in one, or a file that was opened lately"},
    {"Variant", "Which materials the models show"},
    {"Triangles", "Of all objects, each as often as it is placed"},
    {"Lights", "Lights of the scene, those that are off included"},
    {"Materials", "Materials of the scene, those that nothing has included"},
    // Lights
    {"Type", "What the light shines from"},
    {"Colour", "Of the surface, or of the light"},
    {"Intensity", "How bright the light is, in the unit that stands behind the number"},
    {"A, B, C", "How the light falls off with the distance d"},
    {"Range", "How far the light shines; without an end it reaches everything"},
    {"Inner cone", "Within this angle from its direction a spot has all of its brightness"},
    {"Outer cone", "Beyond this angle from its direction a spot does not shine"},
    {"Width", "Of the surface that shines"},
    {"Height", "Of the surface that shines"},
    {"Length", "Of the tube that shines"},
    {"Radius", "Of the light: a larger one makes softer shadows"},
    {"Angular radius", "Of the light as it is seen: a larger one makes softer shadows"},
    {"Shines", "Whether its back shines too"},
    {"Texture", "A picture of factors of its radiance"},
    {"Surface", "Whether pictures show what shines"},
    {"Position", "In the scene, metres; or drag its marker or an arm in the picture"},
    {"Direction", "In which it shines; or drag its round handle in the picture"},
    {"Corners", "How many the outline has, 3 to 8"},
    {"Width along", "Where its width runs"},
    {"Corners along", "Where the first numbers of its corners run"},
    {"Shadow", "Whether shadows fall"},
    {"Moves", "Whether the light moves by itself"},
    {"Flickers", "Whether its brightness wavers by itself"},
    {"Flicker amount", "How much the brightness wavers"},
    {"Flicker speed", "How fast the brightness wavers"},
    {"Scatter", "How many lights take the place of the scene's, over its surfaces"},
    {"Markers", "Whether the picture shows where lights are"},
    // Materials
    {"Material", "The material that is edited"},
    {"Model", "The formula by which the surface answers light"},
    {"Exponent", "How narrow highlights are"},
    {"k_s", "Colour of the highlight"},
    {"Alpha", "Width of the highlight: the square of roughness"},
    {"Alpha x", "Width of the highlight along the tangent"},
    {"Alpha y", "Width of the highlight across the tangent"},
    {"Index n", "Refractive index: the higher, the more the surface reflects"},
    {"Masking", "How much of the rough surface hides itself"},
    {"Metallic", "0 for plastic, wood or stone, 1 for bare metal"},
    {"Roughness", "0 for a mirror, 1 for chalk"},
    {"Specular", "Strength of reflections off what is not metal"},
    {"F0 tint", "Colour of reflections off what is not metal, seen straight on"},
    {"Anisotropy", "How much highlights are stretched, as on brushed metal"},
    {"Turned by", "Angle between the tangent and the direction in which highlights are stretched"},
    {"Clearcoat", "Strength of a clear layer over the surface, as on a car"},
    {"Coat rough", "Roughness of that layer"},
    {"Sheen", "Colour of fibres that glow at the rim, as on velvet"},
    {"Sheen rough", "Roughness of those fibres"},
    {"Iridescence", "Strength of a thin film whose colour changes with the angle, as on a bubble"},
    {"Film index", "Refractive index of that film"},
    {"Film nm", "Thickness of that film, in nanometres: its colours follow from it"},
    {"Least nm", "Thickness of that film where its texture is 0, in nanometres"},
    {"Transmission", "How much light passes through, as through glass"},
    {"Thickness", "How far light goes through the body"},
    {"Absorbs in", "Distance inside the body after which white light has the colour below"},
    {"Down to", "Colour of white light after that distance"},
    {"Dispersion", "How far glass splits light into its colours"},
    {"Subsurface", "Subsurface scattering: how light travels below the surface, as in skin or marble"},
    {"Wrap", "How far light reaches around the body"},
    {"Wrap tint", "Colour of the light that reaches around"},
    {"Body radius", "Radius of the body that light reaches around, which does not shadow itself"},
    {"Absorbs / mm", "Absorption of each colour per millimetre"},
    {"Scale", "Metres that a metre of the model stands for"},
    {"Profile", "How far light of each colour spreads below the surface"},
    {"Albedo before", "Power of the albedo that acts before light spreads; the rest acts after"},
    {"Emission", "Light that the surface emits"},
    {"Alpha mode", "Whether the surface is solid, cut out by its opacity, or lets through what is behind it"},
    {"Opacity", "How much the surface hides of what is behind it"},
    {"Cutoff", "Opacity below which the surface is cut out"},
    {"Normal map", "How deep the texture's bumps are"},
    {"Two sides", "Whether the surface is seen from behind too"},
    // View, environment and camera
    {"Heat colours", "Whether they end at the largest count of the picture, or always at 511 lights or 15 surfaces"},
    {"Resolution", "How many pixels are drawn for each of the window"},
    {"Picture scale", "Share of the window's pixels along each side"},
    {"Map", "What surrounds the scene and lights it"},
    {"Camera", "Cameras of the scene; Home goes back to it"},
    {"Moves by", "What the mouse does with the camera (C)"},
    {"Eye", "Where the camera is"},
    {"Pivot at", "Distance of what the camera turns about"},
    // Animation
    {"Clip", "The animation of the model that plays"},
    {"Time", "Time of the scene, which ends with the clip that plays"},
    {"Speed", "Seconds of the scene that pass in a second"},
    // Compare
    {"Compare", "One picture, two beside each other, or their difference (X)"},
    {"Active side", "The side whose technique, view and options the panels and keys set (Z)"},
    {"Divider", "Where the left picture ends; or drag it"},
    {"Amplified", "How many times the difference is as bright as it is"},
    {"Bit-equal", "Pixels whose numbers are the same to the last bit"},
    {"relMse", "Mean of squared relative errors"},
    {"median rel", "Relative error that half of the pixels stay below"},
    {"p99 rel", "Relative errors that 99 %, and 99.9 %, of the pixels stay below"},
    {"max rel", "The largest relative error, and where it is"},
    {"max abs", "The largest difference of radiance"},
    {"rmse", "Root of the mean of squared differences"},
    {"bias", "Mean difference: whether one picture is brighter"},
    {"FLIP", "Difference that an eye sees between the two, 0 to 1"},
    {"PSNR", "Peak signal-to-noise ratio of the pictures as displays show them"},
    {"Bad pixels", "Pixels with NaN, infinite or negative values"},
    // Lights over time
    {"Way", "How its place changes: around a circle, to and fro, or along a path"},
    {"Centre", "Middle of the circle"},
    {"Axis", "What the circle is run around, counter-clockwise seen from its tip"},
    {"Amplitude", "How far it goes to either side, along each axis"},
    {"Line", "What joins the points: straight lines, or one smooth curve"},
    {"Path", "Whether the last point leads back to the first"},
    {"Looks", "Whether it turns its direction along the path"},
    {"Period", "Time of one round"},
    {"Phase", "Where it is at 0 s, as a share of the period"},
    {"Between", "What values do from one key to the next"},
    {"After", "What follows the last key"},
    {"Median of", "How many pictures like the latest the times are medians of"},
    // Timings, light culling, shadows
    {"Frame", "Time of the latest frame, and its picture's scale"},
    {"Targets", "Memory of render targets"},
    {"Measured", "What the figures below are of"},
    {"All lights", "How many lights a pixel visits on average"},
    {"Most", "How many lights the worst pixel visits, and 99 % of them stay below"},
    {"Without range", "Lights without a range"},
    {"Visited", "Lights with a range that a pixel tries on average"},
    {"Needed", "Lights with a range that reach a pixel on average"},
    {"Lit in front", "Lights with a range that light the front of a pixel's surface on average"},
    {"Tightness", "How well lists of lights fit"},
    {"Lists", "Memory of the lists of lights"},
    {"Missed", "Lights that a pixel needs and its list lacks: must be 0"},
    {"Memory", "Memory of what is kept for shadows"},
    {"Maps", "Shadow maps of the latest frame"},
    {"Atlas", "The texture that holds all shadow maps"},
};

} // namespace

std::string_view meaningOf(std::string_view label) {
    const auto found = std::ranges::find(kMeanings, label, &Meaning::label);
    return found != std::end(kMeanings) ? found->meaning : std::string_view();
}

} // namespace tessera::viewer
