#ifndef snug_tests_benchmark_stopwatch_h
#define snug_tests_benchmark_stopwatch_h

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace snug::benchmark {
/// CPU and wall seconds of this process.
struct Seconds
{
  double cpu  = 0.;
  double wall = 0.;
};

inline Seconds operator+(const Seconds &a, const Seconds &b)
{
  return {a.cpu + b.cpu, a.wall + b.wall};
}

inline Seconds operator-(const Seconds &a, const Seconds &b)
{
  return {a.cpu - b.cpu, a.wall - b.wall};
}

inline Seconds operator*(double factor, const Seconds &a)
{
  return {factor * a.cpu, factor * a.wall};
}

/// Return the time of @p work.
template <typename Work>
Seconds measure(const Work &work)
{
  const auto         wall = std::chrono::steady_clock::now();
  const std::clock_t cpu  = std::clock();
  work();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall;
  return {double(std::clock() - cpu) / CLOCKS_PER_SEC, passed.count()};
}

/// The middle of an odd number of values, the upper middle of an even one.
inline double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

inline Seconds median(const std::vector<Seconds> &values)
{
  std::vector<double> cpu, wall;
  for (const Seconds &value : values)
    {
      cpu.push_back(value.cpu);
      wall.push_back(value.wall);
    }
  return {median(cpu), median(wall)};
}

/// Median time of one call of @p work.
template <typename Work>
Seconds median_time(unsigned int repeats, const Work &work)
{
  std::vector<Seconds> times;
  for (unsigned int i = 0; i < repeats; ++i)
    times.push_back(measure(work));
  return median(times);
}
} // namespace snug::benchmark

#endif
