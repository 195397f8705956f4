#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

/// Reference for the vertices of a glTF file at a time of a clip, independent of the importer: its own accessor reader,
/// linear search of keys, rotations by axis and angle, splines by de Casteljau, and points transformed node by node up
/// the hierarchy instead of by matrix products. It shares only the vectors of GLM with the importer and the poses.
namespace tessera::scenes::gltf::test {

class TruthOfAnimation {
public:
    using Json = nlohmann::json;
    using Point = glm::dvec3;
    /// A triangle's corner.
    struct Corner {
        Point placeWS{0.0};
        Point normalWS{0.0}; ///< not normalised; the triangle's where the mesh has no normals
        bool mirrored = false;
    };

    explicit TruthOfAnimation(const std::filesystem::path& file) {
        std::string bytes = contents(file);
        std::string binary;
        if (bytes.starts_with("glTF")) {
            const std::size_t length = number<std::uint32_t>(bytes, 12);
            if (20 + length + 8 < bytes.size()) binary = bytes.substr(20 + length + 8);
            bytes = bytes.substr(20, length);
        }
        json_ = Json::parse(bytes);
        for (const Json& buffer : listOf(json_, "buffers")) {
            const std::string uri = buffer.value("uri", "");
            if (uri.empty())
                buffers_.push_back(binary);
            else if (uri.starts_with("data:"))
                buffers_.push_back(decoded(uri.substr(uri.find(',') + 1)));
            else
                buffers_.push_back(contents(file.parent_path() / uri));
        }
        const Json nodes = listOf(json_, "nodes");
        parents_.assign(nodes.size(), -1);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const int child : nodes[i].value("children", std::vector<int>()))
                parents_[std::size_t(child)] = int(i);
    }

    std::size_t clips() const { return listOf(json_, "animations").size(); }

    /// Time of a clip's last key.
    double lengthSeconds(std::size_t clip) const {
        double seconds = 0.0;
        for (const Json& sampler : json_["animations"][clip]["samplers"])
            seconds = std::max(seconds, accessor(sampler["input"]).back()[0]);
        return seconds;
    }

    /// Corners of all triangles in the order in which the scene has them: meshes without a skin depth first, then those
    /// with one. `clip` -1 is none.
    std::vector<Corner> corners(int clip, double timeSeconds) {
        pose(clip, timeSeconds);
        std::vector<Corner> all;
        for (const bool skinned : {false, true})
            for (const int root : json_["scenes"][json_.value("scene", 0)]["nodes"].get<std::vector<int>>())
                addBelow(root, skinned, all);
        return all;
    }

    std::size_t skins() const { return listOf(json_, "skins").size(); }
    /// Number of joints of the first skin.
    std::size_t joints() const { return json_["skins"][0]["joints"].size(); }
    /// Transforms a position (`w` 1) or direction (0) from the bind space of the first skin by a joint's matrix, at the
    /// time of the latest corners().
    Point byJoint(std::size_t joint, const Point& p, double w) const {
        const Json& skin = json_["skins"][0];
        const bool isBound = skin.contains("inverseBindMatrices");
        return outOf(skin["joints"].at(joint).get<int>(),
                     isBound ? byMatrix(accessor(skin["inverseBindMatrices"].get<int>()).at(joint), p, w) : p, w);
    }

private:
    using Numbers = std::vector<double>;

    static std::string contents(const std::filesystem::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    static Json listOf(const Json& object, const char* key) { return object.value(key, Json::array()); }

    template <typename Number>
    static Number number(const std::string& bytes, std::size_t at) {
        Number value{};
        for (std::size_t i = 0; i < sizeof(Number); ++i) reinterpret_cast<char*>(&value)[i] = bytes.at(at + i);
        return value;
    }

    static std::string decoded(const std::string& text) {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string bytes;
        unsigned bits = 0;
        int have = 0;
        for (const char c : text) {
            const std::size_t digit = digits.find(c);
            if (digit == std::string::npos) break;
            bits = bits << 6 | unsigned(digit);
            if ((have += 6) >= 8) bytes += char(bits >> (have -= 8) & 255u);
        }
        return bytes;
    }

    double component(const std::string& bytes, std::size_t at, int type, bool normalized) const {
        switch (type) {
        case 5120:
            return normalized ? std::max(number<std::int8_t>(bytes, at) / 127.0, -1.0) : number<std::int8_t>(bytes, at);
        case 5121:
            return number<std::uint8_t>(bytes, at) / (normalized ? 255.0 : 1.0);
        case 5122:
            return normalized ? std::max(number<std::int16_t>(bytes, at) / 32767.0, -1.0)
                              : number<std::int16_t>(bytes, at);
        case 5123:
            return number<std::uint16_t>(bytes, at) / (normalized ? 65535.0 : 1.0);
        case 5125:
            return number<std::uint32_t>(bytes, at);
        default:
            return double(number<float>(bytes, at));
        }
    }

    static std::size_t bytesOfType(int type) { return type < 5122 ? 1 : type < 5124 ? 2 : 4; }

    const std::vector<Numbers>& accessor(int index) const {
        const auto [entry, isNew] = accessors_.try_emplace(index);
        if (!isNew) return entry->second;
        const Json& stored = json_["accessors"][std::size_t(index)];
        static const std::map<std::string, std::size_t> kWidths{
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        const std::size_t width = kWidths.at(stored["type"]), count = stored["count"];
        const int type = stored["componentType"];
        const bool normalized = stored.value("normalized", false);
        std::vector<Numbers>& elements = entry->second;
        elements.assign(count, Numbers(width, 0.0));
        const auto fill = [&](Numbers& element, const Json& view, std::size_t at) {
            const std::string& bytes = buffers_[view["buffer"].get<std::size_t>()];
            for (std::size_t c = 0; c < width; ++c)
                element[c] = component(bytes, at + c * bytesOfType(type), type, normalized);
        };
        if (stored.contains("bufferView")) {
            const Json& view = json_["bufferViews"][stored["bufferView"].get<std::size_t>()];
            const std::size_t step = view.value("byteStride", width * bytesOfType(type));
            const std::size_t first =
                view.value("byteOffset", std::size_t{0}) + stored.value("byteOffset", std::size_t{0});
            for (std::size_t i = 0; i < count; ++i) fill(elements[i], view, first + i * step);
        }
        if (stored.contains("sparse")) {
            const Json& sparse = stored["sparse"];
            const Json& places = json_["bufferViews"][sparse["indices"]["bufferView"].get<std::size_t>()];
            const Json& values = json_["bufferViews"][sparse["values"]["bufferView"].get<std::size_t>()];
            const int indexType = sparse["indices"]["componentType"];
            for (std::size_t i = 0; i < sparse["count"].get<std::size_t>(); ++i) {
                const std::size_t at = places.value("byteOffset", std::size_t{0}) +
                                       sparse["indices"].value("byteOffset", std::size_t{0}) +
                                       i * bytesOfType(indexType);
                const double target = component(buffers_[places["buffer"].get<std::size_t>()], at, indexType, false);
                fill(elements.at(std::size_t(target)), values,
                     values.value("byteOffset", std::size_t{0}) + sparse["values"].value("byteOffset", std::size_t{0}) +
                         i * width * bytesOfType(type));
            }
        }
        return elements;
    }

    // ---- Curves ----------------------------------------------------------------------------------------------------

    static Numbers product(const Numbers& p, const Numbers& q) {
        return {p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
                p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
                p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3],
                p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2]};
    }
    static Numbers unit(Numbers q) {
        double square = 0.0;
        for (const double c : q) square += c * c;
        for (double& c : q) c /= std::sqrt(square);
        return q;
    }
    static Numbers inverse(const Numbers& q) { return {-q[0], -q[1], -q[2], q[3]}; }

    /// Interpolates rotations by axis and angle.
    static Numbers turned(const Numbers& from, const Numbers& to, double share) {
        Numbers turn = product(inverse(from), to);
        if (turn[3] < 0.0)
            for (double& c : turn) c = -c;
        const double sine = std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
        if (sine == 0.0) return from;
        const double half = share * std::atan2(sine, turn[3]);
        return product(from, {turn[0] / sine * std::sin(half), turn[1] / sine * std::sin(half),
                              turn[2] / sine * std::sin(half), std::cos(half)});
    }

    Numbers sampled(const Json& sampler, bool isRotation, std::size_t width, double time) const {
        const std::vector<Numbers>& times = accessor(sampler["input"]);
        const std::string way = sampler.value("interpolation", "LINEAR");
        Numbers flat;
        for (const Numbers& element : accessor(sampler["output"]))
            flat.insert(flat.end(), element.begin(), element.end());
        const auto value = [&](std::size_t which) {
            const auto first = flat.begin() + std::ptrdiff_t(which * width);
            return Numbers(first, first + std::ptrdiff_t(width));
        };
        const bool isSpline = way == "CUBICSPLINE";
        const auto key = [&](std::size_t i) {
            const Numbers stored = value(isSpline ? 3 * i + 1 : i);
            return isRotation ? unit(stored) : stored;
        };
        if (time <= times.front()[0]) return key(0);
        for (std::size_t i = 0; i + 1 < times.size(); ++i) {
            const double from = times[i][0], to = times[i + 1][0];
            if (time >= to) continue;
            if (way == "STEP") return key(i);
            const double share = (time - from) / (to - from);
            if (!isSpline) {
                if (isRotation) return turned(key(i), key(i + 1), share);
                Numbers between = key(i);
                for (std::size_t c = 0; c < width; ++c) between[c] += share * (key(i + 1)[c] - between[c]);
                return between;
            }
            // As a Bezier curve.
            const Numbers a = value(3 * i + 1), out = value(3 * i + 2), in = value(3 * i + 3), d = value(3 * i + 4);
            Numbers result(width);
            for (std::size_t c = 0; c < width; ++c) {
                double p[4] = {a[c], a[c] + (to - from) * out[c] / 3.0, d[c] - (to - from) * in[c] / 3.0, d[c]};
                for (int left = 3; left > 0; --left)
                    for (int k = 0; k < left; ++k) p[k] += share * (p[k + 1] - p[k]);
                result[c] = p[0];
            }
            return isRotation ? unit(result) : result;
        }
        return key(times.size() - 1);
    }

    // ---- Poses -----------------------------------------------------------------------------------------------------

    struct Parts {
        Numbers translation{0, 0, 0}, rotation{0, 0, 0, 1}, scale{1, 1, 1}, matrix, weights;
    };

    void pose(int clip, double time) {
        parts_.clear();
        for (const Json& node : listOf(json_, "nodes")) {
            Parts& parts = parts_.emplace_back();
            parts.translation = node.value("translation", parts.translation);
            parts.rotation = unit(node.value("rotation", parts.rotation));
            parts.scale = node.value("scale", parts.scale);
            parts.matrix = node.value("matrix", Numbers());
            if (!node.contains("mesh")) continue;
            const Json& mesh = json_["meshes"][node["mesh"].get<std::size_t>()];
            std::size_t targets = 0;
            for (const Json& primitive : mesh["primitives"])
                targets = std::max(targets, listOf(primitive, "targets").size());
            parts.weights = node.value("weights", mesh.value("weights", Numbers()));
            parts.weights.resize(targets, 0.0);
        }
        if (clip < 0) return;
        const Json& animation = json_["animations"][std::size_t(clip)];
        for (const Json& channel : animation["channels"]) {
            const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
            Parts& parts = parts_.at(channel["target"]["node"].get<std::size_t>());
            const std::string path = channel["target"]["path"];
            if (path == "translation") parts.translation = sampled(sampler, false, 3, time);
            if (path == "rotation") parts.rotation = sampled(sampler, true, 4, time);
            if (path == "scale") parts.scale = sampled(sampler, false, 3, time);
            if (path == "weights") parts.weights = sampled(sampler, false, parts.weights.size(), time);
        }
    }

    static Point rotated(const Numbers& q, const Point& p) {
        const Point axis{q[0], q[1], q[2]}, across = glm::cross(axis, p);
        return p + 2.0 * (q[3] * across + glm::cross(axis, across));
    }

    /// Transforms from node to world space; `w` is 1 for positions, 0 for directions.
    Point outOf(int node, Point p, double w) const {
        for (; node >= 0; node = parents_[std::size_t(node)]) {
            const Parts& parts = parts_[std::size_t(node)];
            if (!parts.matrix.empty()) {
                p = byMatrix(parts.matrix, p, w);
                continue;
            }
            p = rotated(parts.rotation, p * pointOf(parts.scale)) + w * pointOf(parts.translation);
        }
        return p;
    }
    static Point pointOf(const Numbers& n) { return {n[0], n[1], n[2]}; }
    static Point byMatrix(const Numbers& m, const Point& p, double w) {
        Point result{0.0};
        for (std::size_t column = 0; column < 4; ++column)
            result += (column < 3 ? p[int(column)] : w) * Point(m[4 * column], m[4 * column + 1], m[4 * column + 2]);
        return result;
    }

    struct Influence {
        int joint;
        Numbers inverseBind; ///< empty: the identity
        double weight;
    };

    Point moved(int node, const std::vector<Influence>& influences, const Point& p, double w) const {
        Point sum{0.0};
        double weights = 0.0;
        for (const Influence& influence : influences) {
            const Point bound = influence.inverseBind.empty() ? p : byMatrix(influence.inverseBind, p, w);
            sum += influence.weight * outOf(influence.joint, bound, w);
            weights += influence.weight;
        }
        return weights == 0.0 ? outOf(node, p, w) : sum / weights;
    }

    void addBelow(int index, bool skinned, std::vector<Corner>& all) const {
        const Json& node = json_["nodes"][std::size_t(index)];
        if (node.contains("mesh") && node.contains("skin") == skinned)
            for (const Json& primitive : json_["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
                addPrimitive(index, primitive, all);
        for (const int child : node.value("children", std::vector<int>())) addBelow(child, skinned, all);
    }

    std::vector<Influence> influencesOf(const Json& node, const Json& attributes, std::size_t vertex) const {
        std::vector<Influence> influences;
        if (!node.contains("skin")) return influences;
        const Json& skin = json_["skins"][node["skin"].get<std::size_t>()];
        for (const std::string set : {"0", "1"}) {
            if (!attributes.contains("JOINTS_" + set)) continue;
            const Numbers& joints = accessor(attributes["JOINTS_" + set])[vertex];
            const Numbers& weights = accessor(attributes["WEIGHTS_" + set])[vertex];
            for (std::size_t i = 0; i < 4; ++i) {
                if (weights[i] <= 0.0) continue;
                const auto joint = std::size_t(joints[i]);
                influences.push_back({skin["joints"].at(joint), {}, weights[i]});
                if (skin.contains("inverseBindMatrices"))
                    influences.back().inverseBind = accessor(skin["inverseBindMatrices"]).at(joint);
            }
        }
        return influences;
    }

    void addPrimitive(int index, const Json& primitive, std::vector<Corner>& all) const {
        const Json& node = json_["nodes"][std::size_t(index)];
        const Json& attributes = primitive["attributes"];
        const Numbers& targetWeights = parts_[std::size_t(index)].weights;
        const std::vector<Numbers>& rest = accessor(attributes["POSITION"]);
        const auto morphed = [&](const char* attribute, std::size_t vertex) {
            Numbers sum = accessor(attributes[attribute])[vertex];
            const Json targets = listOf(primitive, "targets");
            for (std::size_t t = 0; t < targets.size(); ++t)
                if (targets[t].contains(attribute))
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] += targetWeights[t] * accessor(targets[t][attribute])[vertex][c];
            return pointOf(sum);
        };
        std::vector<Corner> corners;
        for (std::size_t vertex = 0; vertex < rest.size(); ++vertex) {
            const std::vector<Influence> influences = influencesOf(node, attributes, vertex);
            Corner& corner = corners.emplace_back();
            corner.placeWS = moved(index, influences, morphed("POSITION", vertex), 1.0);
            // A plane's normal, by two directions in it.
            const Point a = moved(index, influences, {1, 0, 0}, 0.0), b = moved(index, influences, {0, 1, 0}, 0.0),
                        c = moved(index, influences, {0, 0, 1}, 0.0);
            const Point bc = glm::cross(b, c);
            corner.mirrored = glm::dot(a, bc) < 0.0;
            if (!attributes.contains("NORMAL")) continue;
            const Point n = morphed("NORMAL", vertex);
            corner.normalWS = n.x * bc + n.y * glm::cross(c, a) + n.z * glm::cross(a, b);
        }
        const std::size_t first = all.size();
        if (primitive.contains("indices"))
            for (const Numbers& vertex : accessor(primitive["indices"]))
                all.push_back(corners.at(std::size_t(vertex[0])));
        else
            all.insert(all.end(), corners.begin(), corners.end());
        if (attributes.contains("NORMAL")) return;
        for (std::size_t i = first; i + 2 < all.size(); i += 3) { // flat normals
            const Point normalWS = glm::cross(all[i + 1].placeWS - all[i].placeWS, all[i + 2].placeWS - all[i].placeWS);
            for (std::size_t corner = i; corner < i + 3; ++corner) all[corner].normalWS = normalWS;
        }
    }

    Json json_;
    std::vector<std::string> buffers_;
    std::vector<int> parents_;
    mutable std::map<int, std::vector<Numbers>> accessors_;
    std::vector<Parts> parts_; ///< by node
};

} // namespace tessera::scenes::gltf::test
