# FFTW ships no CMake package on Debian. Defines the target FFTW3f::FFTW3f, the single-precision library.
include(FindPackageHandleStandardArgs)
find_path(FFTW3f_INCLUDE_DIR fftw3.h)
find_library(FFTW3f_LIBRARY fftw3f)
mark_as_advanced(FFTW3f_INCLUDE_DIR FFTW3f_LIBRARY)
find_package_handle_standard_args(FFTW3f REQUIRED_VARS FFTW3f_LIBRARY FFTW3f_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian and Ubuntu have it as libfftw3-dev.")
if(FFTW3f_FOUND AND NOT TARGET FFTW3f::FFTW3f)
  add_library(FFTW3f::FFTW3f UNKNOWN IMPORTED)
  set_target_properties(FFTW3f::FFTW3f PROPERTIES
    IMPORTED_LOCATION "${FFTW3f_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${FFTW3f_INCLUDE_DIR}")
endif()
