#ifndef snug_faces_point_field_h
#define snug_faces_point_field_h

#include <snug/faces/recording.h>
#include <snug/mesh/surface.h>

#include <unordered_map>

namespace snug::faces {
/**
 * This class gives vectors at surface points (positions, normals) as numbers of a type: double for
 * values, Differential<1> for derivatives along a velocity, Recorded for derivatives with respect
 * to all of them. Functions of a surface that read points through this class are differentiated
 * exactly. The fields must outlive it.
 */
template <int dim, typename Number>
class PointField;

template <int dim>
class PointField<dim, double>
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  explicit PointField(const Field &values) : field(values) {}

  /// Return the vector of point @p i.
  const dealii::Tensor<1, dim> &operator[](unsigned int i) const { return field[i]; }

  /// Return the vectors without derivatives.
  const Field &values() const { return field; }

private:
  const Field &field;
};

template <int dim>
class PointField<dim, Differential<1>>
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  PointField(const Field &values, const Field &velocity) : field(values), velocity(velocity) {}

  dealii::Tensor<1, dim, Differential<1>> operator[](unsigned int i) const
  {
    dealii::Tensor<1, dim, Differential<1>> result;
    for (int d = 0; d < dim; ++d)
      {
        result[d].value    = field[i][d];
        result[d].slope[0] = velocity[i][d];
      }
    return result;
  }

  const Field &values() const { return field; }

private:
  const Field &field, &velocity;
};

template <int dim>
class PointField<dim, Recorded>
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Points become variables of @p recording where they are first read.
  PointField(const Field &values, Recording &recording) : field(values), recording(recording) {}

  const dealii::Tensor<1, dim, Recorded> &operator[](unsigned int i) const
  {
    const auto [at, is_new] = read.try_emplace(i);
    for (int d = 0; d < dim && is_new; ++d)
      at->second[d] = recording.variable(field[i][d]);
    return at->second;
  }

  const Field &values() const { return field; }

  /// Add the derivatives of the recording's scalar with respect to the points that were read.
  void add_derivatives(Field &gradient) const
  {
    for (const auto &[i, vector] : read)
      for (int d = 0; d < dim; ++d)
        gradient[i][d] += recording.derivative(vector[d]);
  }

private:
  const Field                                                               &field;
  Recording                                                                 &recording;
  mutable std::unordered_map<unsigned int, dealii::Tensor<1, dim, Recorded>> read;
};
} // namespace snug::faces

#endif
