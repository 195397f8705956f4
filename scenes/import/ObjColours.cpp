#include "scenes/import/ObjText.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/Srgb.h"

namespace tessera::scenes::obj {
namespace {

const glm::vec3 kMissing(std::numeric_limits<float>::quiet_NaN());
/// Colours of 0..1 are rounded above 1, but never this far.
constexpr float kLeastByte = 2.0f;
constexpr float kMostByte = 255.0f;

bool isMissing(const glm::vec3& colour) {
    return std::isnan(colour.x);
}
float largestOf(const glm::vec3& colour) {
    return std::max({colour.x, colour.y, colour.z});
}

} // namespace

void VertexColours::read(const Line& line, std::size_t position) {
    constexpr std::size_t kFirst = 3, kCount = 3;
    if (line.words.size() < kFirst + kCount) return; // five numbers are a position and no colour
    glm::vec3 colour;
    std::string flaw;
    for (std::size_t i = 0; i < kCount; ++i)
        colour[static_cast<glm::length_t>(i)] =
            static_cast<float>(finiteNumber(line.keyword, line.words[kFirst + i], flaw).value_or(0.0));
    if (!flaw.empty()) {
        if (flaw_.empty()) flawLine_ = line.number, flaw_ = flaw;
        return;
    }
    if (largeLine_ == 0 && largestOf(colour) >= kLeastByte) largeLine_ = line.number;
    colours_.resize(position, kMissing);
    colours_.push_back(colour);
}

std::vector<glm::vec3> VertexColours::take(const std::string& file, ObjColours encoding,
                                           const std::vector<bool>& isUsed, Repairs& repairs) {
    if (colours_.empty()) return {};
    colours_.resize(isUsed.size(), kMissing);
    std::size_t missing = 0, used = 0;
    float largest = 0.0f;
    for (std::size_t i = 0; i < isUsed.size(); ++i) {
        if (!isUsed[i]) continue;
        ++used;
        if (isMissing(colours_[i]))
            ++missing;
        else
            largest = std::max(largest, largestOf(colours_[i]));
    }
    if (missing == used) return {};
    if (missing > 0)
        repairs.note(file, flawLine_, "these are white", "{} of {} vertices have no colour{}{}", missing, used,
                     flaw_.empty() ? "" : ": ", flaw_);
    const bool isBytes = largest >= kLeastByte;
    if (isBytes)
        repairs.note(file, largeLine_, "they are divided by 255", "colours of vertices are up to {}, not 0 to 1",
                     largest);
    for (std::size_t i = 0; i < isUsed.size(); ++i) {
        glm::vec3& colour = colours_[i];
        if (isMissing(colour)) colour = glm::vec3(isBytes ? kMostByte : 1.0f);
        const glm::vec3 written = isBytes ? colour / kMostByte : colour;
        colour = glm::clamp(written, 0.0f, 1.0f);
        if (isUsed[i] && colour != written)
            repairs.note(file, 0, "the nearest bound is taken", "the colour {} {} {} of vertex {} is not within {}",
                         written.x, written.y, written.z, i + 1, isBytes ? "0 to 255" : "0 to 1");
        if (encoding == ObjColours::Linear) continue;
        for (glm::length_t c = 0; c < 3; ++c) colour[c] = static_cast<float>(linearFromSrgb(double(colour[c])));
    }
    return std::move(colours_);
}

} // namespace tessera::scenes::obj
