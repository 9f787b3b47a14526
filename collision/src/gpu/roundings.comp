#version 450
#extension GL_GOOGLE_include_directive : require

// Computes what a device must round as GPU.md needs it. rounding_check.cpp judges the results.

#define real float
#include "hit_rounding.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 2) readonly buffer Numbers { float numbers[]; };    // Three a case.
layout(std430, binding = 4) writeonly buffer Results { float results[]; };  // Nine a case.

layout(push_constant) uniform Dispatch {
  uint case_count;
  uint unused_1, unused_2, unused_3, unused_4;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= case_count) return;
  float a = numbers[3 * i];
  float b = numbers[3 * i + 1];
  float c = numbers[3 * i + 2];
  precise float sum = a + b;
  precise float difference = a - b;
  precise float product = a * b;
  precise float quotient = a / b;
  precise float product_and_sum = a * b + c;
  FloatPair sum_pair = sum_of(a, b);
  FloatPair product_pair = product_of(a, b);
  results[9 * i] = sum;
  results[9 * i + 1] = difference;
  results[9 * i + 2] = product;
  results[9 * i + 3] = quotient;
  results[9 * i + 4] = product_and_sum;
  results[9 * i + 5] = sum_pair.high;
  results[9 * i + 6] = sum_pair.low;
  results[9 * i + 7] = product_pair.high;
  results[9 * i + 8] = product_pair.low;
}
