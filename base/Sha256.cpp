#include "base/Sha256.h"

#include <stdexcept>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace tessera {

struct Sha256::State {
    EVP_MD_CTX* context = EVP_MD_CTX_new();
    ~State() { EVP_MD_CTX_free(context); }
};

namespace {
void require(bool isGood) {
    if (!isGood) throw std::runtime_error("libcrypto computes no SHA-256; check its installation");
}
} // namespace

Sha256::Sha256() : state_(std::make_unique<State>()) {
    require(state_->context != nullptr && EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) == 1);
}
Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
    require(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1);
}

Sha256Digest Sha256::digest() {
    Sha256Digest digest{};
    require(EVP_DigestFinal_ex(state_->context, reinterpret_cast<unsigned char*>(digest.data()), nullptr) == 1);
    return digest;
}

std::string hexadecimal(const Sha256Digest& digest) {
    std::string text;
    for (const std::byte byte : digest) text += fmt::format("{:02x}", std::to_integer<int>(byte));
    return text;
}

} // namespace tessera
