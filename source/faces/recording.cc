#include <snug/faces/recording.h>

namespace snug::faces {
Recorded Recording::add_step(const double value)
{
  steps.push_back({static_cast<unsigned int>(operands.size())});
  return {value, this, static_cast<unsigned int>(steps.size() - 1)};
}

Recorded Recording::variable(const double value)
{
  return add_step(value);
}

Recorded Recording::operation(const double    value,
                              const Recorded &a,
                              const double    by_a,
                              const Recorded &b,
                              const double    by_b)
{
  Recording *const recording = a.recording ? a.recording : b.recording;
  if (!recording)
    return value;
  if (a.recording)
    recording->operands.push_back({a.step, by_a});
  if (b.recording)
    recording->operands.push_back({b.step, by_b});
  return recording->add_step(value);
}
} // namespace snug::faces
