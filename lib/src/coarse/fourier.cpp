#include "fourier.hpp"

#include <fftw3.h>

#include <mutex>

namespace tcm_icp {
namespace {

// FFTW makes and destroys plans in one thread at a time; it executes them in any number.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

fftwf_complex* as_fftw(std::complex<float>* z) { return reinterpret_cast<fftwf_complex*>(z); }

}  // namespace

struct Fourier::Plans {
  fftwf_plan forward = nullptr;
  fftwf_plan inverse = nullptr;
};

Fourier::Fourier(int size) : size_(size), plans_(std::make_unique<Plans>()) {
  Image image(num_pixels());
  Spectrum spectrum(spectrum_size());
  constexpr unsigned kFlags = FFTW_ESTIMATE;
  const std::lock_guard lock(planner_mutex());
  plans_->forward =
      fftwf_plan_dft_r2c_2d(size, size, image.data(), as_fftw(spectrum.data()), kFlags | FFTW_PRESERVE_INPUT);
  plans_->inverse = fftwf_plan_dft_c2r_2d(size, size, as_fftw(spectrum.data()), image.data(), kFlags);
}

Fourier::~Fourier() {
  const std::lock_guard lock(planner_mutex());
  fftwf_destroy_plan(plans_->forward);
  fftwf_destroy_plan(plans_->inverse);
}

std::size_t Fourier::num_pixels() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }

std::size_t Fourier::spectrum_size() const {
  return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_ / 2 + 1);
}

void Fourier::forward(const Image& image, Spectrum& spectrum) const {
  spectrum.resize(spectrum_size());
  // FFTW_PRESERVE_INPUT: the image is only read.
  fftwf_execute_dft_r2c(plans_->forward, const_cast<float*>(image.data()), as_fftw(spectrum.data()));
}

void Fourier::inverse(Spectrum& spectrum, Image& image) const {
  image.resize(num_pixels());
  fftwf_execute_dft_c2r(plans_->inverse, as_fftw(spectrum.data()), image.data());
}

int fast_size(int at_least) {
  for (int size = (at_least + 7) / 8 * 8;; size += 8) {
    int rest = size;
    for (const int factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return size;
  }
}

}  // namespace tcm_icp
