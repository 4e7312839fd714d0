#pragma once
// Discrete Fourier transforms of square real images (FFTW, hidden).

#include <complex>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace tcm_icp {

/// Memory at multiples of 64 bytes: FFTW's vector instructions need it, and it makes them the same in every run.
template <typename T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  AlignedAllocator() = default;
  template <typename U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

using Image = std::vector<float, AlignedAllocator<float>>;
using Spectrum = std::vector<std::complex<float>, AlignedAllocator<std::complex<float>>>;

/// Transforms of size x size images of floats. A spectrum holds size x (size / 2 + 1) values, row by row; the inverse
/// is not divided by size^2. Plans are made in the constructor, without timing them, so that every run computes the
/// same; transforms are const and thread-safe.
class Fourier {
 public:
  explicit Fourier(int size);  ///< size >= 1
  ~Fourier();
  Fourier(const Fourier&) = delete;
  Fourier& operator=(const Fourier&) = delete;

  int size() const { return size_; }
  std::size_t num_pixels() const;
  std::size_t spectrum_size() const;

  /// Both resize what they write.
  void forward(const Image& image, Spectrum& spectrum) const;
  void inverse(Spectrum& spectrum, Image& image) const;  ///< overwrites the spectrum

 private:
  struct Plans;
  int size_;
  std::unique_ptr<Plans> plans_;
};

/// Smallest size >= `at_least` that transforms fast: a multiple of 8, with factors 2, 3 and 5 only.
int fast_size(int at_least);

}  // namespace tcm_icp
