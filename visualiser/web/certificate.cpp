// Uses OpenSSL. A generated certificate is kept with its key in one private file. It is used again only if its names
// cover all present ones and it stays valid for a month; otherwise a new key and certificate replace it.
#include "visualiser/web/certificate.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netdb.h>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr long kDay_s = 86400;
constexpr long kValid_s = 365 * kDay_s;
constexpr long kRenewed_s = 30 * kDay_s;  // before the end of its validity
constexpr std::size_t kLongestFile = 1 << 20;

template <auto Free>
struct Freed
{
  template <class T>
  void operator()(T* object) const
  {
    Free(object);
  }
};
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using X509Certificate = std::unique_ptr<X509, Freed<X509_free>>;

[[noreturn]] void Fail(const std::string& what)
{
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  throw std::runtime_error(fmt::format("web_render: {}: {}", what, reason.data()));
}

bool IsAddress(const std::string& name)
{
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, name.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, name.c_str(), address.data()) == 1;
}

std::string TextOf(BIO* memory)
{
  const char* text = nullptr;
  const long length = BIO_get_mem_data(memory, &text);
  return {text, static_cast<std::size_t>(length)};
}

X509Certificate FirstOf(const std::string& pem)
{
  const Bio memory(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  return X509Certificate(PEM_read_bio_X509(memory.get(), nullptr, nullptr, nullptr));
}

Key KeyOf(const std::string& pem)
{
  const Bio memory(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  // No user is asked for a password: a key with one is an error.
  const auto no_password = [](char*, int, int, void*) { return -1; };
  return Key(PEM_read_bio_PrivateKey(memory.get(), nullptr, no_password, nullptr));
}

std::string FingerprintOf(const X509& certificate)
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (X509_digest(&certificate, EVP_sha256(), digest.data(), &length) != 1) Fail("cannot digest its certificate");
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest[i]);
  return text;
}

// Returns the content of a file; nothing if other users can access the file.
std::optional<std::string> ReadPrivate(const std::filesystem::path& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return std::nullopt;
  struct stat status
  {
  };
  std::optional<std::string> text;
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
      (status.st_mode & 077) == 0 && static_cast<std::size_t>(status.st_size) <= kLongestFile)
  {
    text.emplace(static_cast<std::size_t>(status.st_size), '\0');
    if (read(file, text->data(), text->size()) != static_cast<ssize_t>(text->size())) text.reset();
  }
  close(file);
  return text;
}

// Writes the file under another name and renames it, so that a reader meanwhile gets the old one.
void WritePrivate(const std::filesystem::path& path, const std::string& text)
{
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const std::string other = fmt::format("{}.{}", path.string(), getpid());
  const int file = open(other.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) return;
  const bool whole = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  if (!whole || rename(other.c_str(), path.c_str()) != 0) unlink(other.c_str());
}

Certificate CertificateOf(const std::string& pem, const std::string& whose)
{
  const X509Certificate first = FirstOf(pem);
  if (!first) Fail(fmt::format("{} has no certificate in the form PEM", whose));
  const Key key = KeyOf(pem);
  if (!key) Fail(fmt::format("{} has no private key without a password in the form PEM", whose));
  if (X509_check_private_key(first.get(), key.get()) != 1)
    Fail(fmt::format("in {} the private key is not that of the first certificate", whose));
  return {pem, pem, FingerprintOf(*first)};
}

bool Serves(const X509& certificate, const std::vector<std::string>& names)
{
  time_t renewed = time(nullptr) + kRenewed_s;
  if (X509_cmp_time(X509_get0_notAfter(&certificate), &renewed) <= 0) return false;
  X509* const checked = const_cast<X509*>(&certificate);  // it is not modified
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name)
                     {
                       return IsAddress(name) ? X509_check_ip_asc(checked, name.c_str(), 0) == 1
                                              : X509_check_host(checked, name.data(), name.size(), 0, nullptr) == 1;
                     });
}

void Extend(X509& certificate, int kind, const std::string& value)
{
  const std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str()));
  if (!extension || X509_add_ext(&certificate, extension.get(), -1) != 1) Fail("cannot make a certificate");
}

std::string NewCertificate(const std::vector<std::string>& names)
{
  const Key key(EVP_EC_gen("P-256"));
  const X509Certificate certificate(X509_new());
  std::array<unsigned char, 16> serial{};
  if (!key || !certificate || RAND_bytes(serial.data(), serial.size()) != 1) Fail("cannot make a certificate");
  serial[0] &= 0x7f;  // makes the number positive
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_bin2bn(serial.data(), serial.size(), nullptr));
  BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate.get()));
  X509_set_version(certificate.get(), X509_VERSION_3);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kDay_s);  // the clocks of other machines differ
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kValid_s);
  X509_set_pubkey(certificate.get(), key.get());
  X509_NAME* const subject = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(subject, "O", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>("Swarmanoid"), -1, -1,
                             0);
  X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>("web_render"), -1, -1,
                             0);
  X509_set_issuer_name(certificate.get(), subject);
  std::string alternatives;
  for (const std::string& name : names)
    alternatives += fmt::format("{}{}:{}", alternatives.empty() ? "" : ",", IsAddress(name) ? "IP" : "DNS", name);
  Extend(*certificate, NID_subject_alt_name, alternatives);
  Extend(*certificate, NID_basic_constraints, "critical,CA:FALSE");
  Extend(*certificate, NID_key_usage, "critical,digitalSignature");
  Extend(*certificate, NID_ext_key_usage, "serverAuth");
  if (X509_sign(certificate.get(), key.get(), EVP_sha256()) == 0) Fail("cannot sign its certificate");

  const Bio memory(BIO_new(BIO_s_mem()));
  if (PEM_write_bio_X509(memory.get(), certificate.get()) != 1 ||
      PEM_write_bio_PrivateKey(memory.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
    Fail("cannot write its certificate");
  return TextOf(memory.get());
}

}  // namespace

Certificate GivenCertificate(const std::string& file)
{
  const Bio input(BIO_new_file(file.c_str(), "r"));
  if (!input) throw std::runtime_error(fmt::format("web_render: cannot read '{}': {}", file, std::strerror(errno)));
  std::string text(kLongestFile, '\0');
  const int length = BIO_read(input.get(), text.data(), static_cast<int>(text.size()));
  text.resize(static_cast<std::size_t>(std::max(length, 0)));
  return CertificateOf(text, fmt::format("'{}'", file));
}

Certificate OwnCertificate(const std::filesystem::path& file, const std::vector<std::string>& names)
{
  if (const auto kept = file.empty() ? std::nullopt : ReadPrivate(file))
  {
    const X509Certificate certificate = FirstOf(*kept);
    if (certificate && KeyOf(*kept) && Serves(*certificate, names)) return CertificateOf(*kept, "the kept certificate");
    ERR_clear_error();
  }
  const std::string made = NewCertificate(names);
  if (!file.empty()) WritePrivate(file, made);
  return CertificateOf(made, "the new certificate");
}

std::vector<std::string> NamesOfThisMachine()
{
  std::vector<std::string> names{"localhost"};
  const auto add = [&](const std::string& name)
  {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) == 0) add(host.data());
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return names;
  const std::unique_ptr<ifaddrs, Freed<freeifaddrs>> keeper(all);
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next)
  {
    if (each->ifa_addr == nullptr) continue;
    const bool four = each->ifa_addr->sa_family == AF_INET;
    if (!four && each->ifa_addr->sa_family != AF_INET6) continue;
    std::array<char, NI_MAXHOST> text{};
    const socklen_t size = four ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    if (getnameinfo(each->ifa_addr, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0) continue;
    // Addresses of a single link ("fe80::1%eth0") are useless in a browser.
    if (std::string_view(text.data()).find('%') == std::string_view::npos) add(text.data());
  }
  return names;
}

}  // namespace swarmanoid
