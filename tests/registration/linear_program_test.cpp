#include "tcm_icp/registration/linear_program.hpp"

#include <gtest/gtest.h>

TEST(Lp, Stub) {}
