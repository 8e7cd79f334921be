// Each function reads two numbers and writes two of each result.
#pragma once

namespace swarmanoid::test
{

void ThroughFloat(const double* x, float* rounded, double* back);
void ThroughInt(const double* x, double* back);

}  // namespace swarmanoid::test
