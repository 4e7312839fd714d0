// Text: a line of names behind '#', then one point a line.

#include "cloud_sink.hpp"
#include "number_text.hpp"

namespace tcm_icp {
namespace {

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
        append_shortest(records + i * layout_.size + column.offset, column.type, text_);
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
