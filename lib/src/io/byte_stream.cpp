#include "byte_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

class PlainBytes : public ByteStream {
 public:
  explicit PlainBytes(fs::path path) : path_(std::move(path)) {
    // The reader's buffer is the only one: without this every byte is copied twice.
    stream_.rdbuf()->pubsetbuf(nullptr, 0);
    stream_.open(path_, std::ios::binary);
    if (!stream_) throw InputError(path_, "", "cannot be opened", "check its permissions");
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path_, error);
    if (!error && size > 0) size_ = size;  // files of the kernel say 0 and hold something
  }

  std::size_t read(std::byte* to, std::size_t n) override {
    stream_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(n));
    if (stream_.bad()) throw InputError(path_, "", "cannot be read", "check the disk");
    return static_cast<std::size_t>(stream_.gcount());
  }

  bool seek(std::uint64_t offset) override {
    if (!size_ || offset > *size_) return false;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(stream_);
  }

  std::optional<std::uint64_t> size() const override { return size_; }

 private:
  fs::path path_;
  std::ifstream stream_;
  std::optional<std::uint64_t> size_;
};

class GzipBytes : public ByteStream {
 public:
  explicit GzipBytes(fs::path path) : path_(std::move(path)), file_(gzopen(path_.c_str(), "rb")) {
    if (!file_) throw InputError(path_, "", "cannot be opened", "check its permissions");
    constexpr unsigned kBuffer = 1U << 18U;  // zlib's own of 8 KiB costs a call of the system for each
    gzbuffer(file_.get(), kBuffer);
  }

  std::size_t read(std::byte* to, std::size_t n) override {
    constexpr std::size_t kAtMost = std::size_t{1} << 30U;  // zlib counts in int
    const int count = gzread(file_.get(), to, static_cast<unsigned>(std::min(n, kAtMost)));
    int error = Z_OK;
    if (count <= 0) gzerror(file_.get(), &error);  // a stream that stops short gives 0 bytes and an error
    if (count < 0 || error != Z_OK) {
      throw InputError(path_, "", "its gzip data are damaged or cut off", "copy or pack the file again");
    }
    return static_cast<std::size_t>(count);
  }

  bool seek(std::uint64_t) override { return false; }
  std::optional<std::uint64_t> size() const override { return std::nullopt; }

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose(file); }
  };
  fs::path path_;
  std::unique_ptr<gzFile_s, Close> file_;
};

}  // namespace

std::unique_ptr<ByteStream> open_bytes(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path, "", "there is no such file", "check the path");
  if (fs::is_directory(status)) throw InputError(path, "", "is a folder", "name the files in it");
  if (!fs::is_regular_file(status)) throw InputError(path, "", "is not a regular file", "copy it to one");
  auto plain = std::make_unique<PlainBytes>(path);
  std::byte magic[2];
  const bool packed = plain->read(magic, 2) == 2 && magic[0] == std::byte{0x1f} && magic[1] == std::byte{0x8b};
  if (packed) return std::make_unique<GzipBytes>(path);
  return std::make_unique<PlainBytes>(path);
}

}  // namespace tcm_icp
