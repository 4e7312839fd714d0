// Text: a line of names behind '#', then one point a line.

#include <array>
#include <charconv>
#include <cstring>

#include "cloud_sink.hpp"
#include "scalar.hpp"

namespace tcm_icp {
namespace {

/// The shortest decimal number that reads as this one, whatever the locale.
void append_number(const std::byte* bytes, ScalarType type, std::string& text) {
  std::array<char, 32> digits;
  std::to_chars_result end{};
  if (type == ScalarType::kFloat32) {
    float value = 0;
    std::memcpy(&value, bytes, sizeof value);
    end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  } else {
    end = std::to_chars(digits.data(), digits.data() + digits.size(), load_scalar(bytes, type));
  }
  text.append(digits.data(), end.ptr);
}

class TextSink : public CloudSink {
 public:
  TextSink(std::filesystem::path path, const RecordLayout& layout) : CloudSink(std::move(path)), layout_(layout) {
    std::string names = "#";
    for (const auto& column : layout.columns) names += ' ' + column.name;
    put(names + '\n');
  }

  void write(const std::byte* records, std::size_t count) override {
    text_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      for (const auto& column : layout_.columns) {
        append_number(records + i * layout_.size + column.offset, column.type, text_);
        text_ += &column == &layout_.columns.back() ? '\n' : ' ';
      }
    }
    put(text_);
  }

 private:
  void complete(std::uint64_t /*num_points*/) override {}

  RecordLayout layout_;
  std::string text_;  ///< of one block
};

}  // namespace

std::unique_ptr<CloudSink> open_text(std::filesystem::path path, const RecordLayout& layout) {
  return std::make_unique<TextSink>(std::move(path), layout);
}

}  // namespace tcm_icp
