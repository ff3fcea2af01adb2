#ifndef snug_advice_conditions_h
#define snug_advice_conditions_h

#include <snug/advice/advice.h>
#include <snug/geometry/formula.h>

namespace snug::advice {
/// A point of a boundary face or inside of a body.
template <int dim>
struct Place
{
  unsigned int                body, boundary = 0;
  dealii::Point<dim>          x        = {};
  dealii::Tensor<1, dim>      normal   = {};      ///< outer unit normal; zero inside of a body
  double                      weight   = 1.;      ///< part of the area or volume of the mesh
  const elasticity::Material *material = nullptr; ///< inside of a body
};

/// Data of a model at a point: geometry, materials, supports, loads and contact. Each datum is a
/// scalar s, a vector v or a tensor T, stored as the blocks of [T v; 0 s]. A rotation or reflection
/// Q of the model maps it to [Q 0; 0 1] [T v; 0 s] [Q 0; 0 1]'.
template <int dim>
using PointData = std::vector<dealii::Tensor<2, dim + 1>>;

/// Return a vector as a datum.
template <int dim>
dealii::Tensor<2, dim + 1> vector_datum(const dealii::Tensor<1, dim> &v)
{
  dealii::Tensor<2, dim + 1> result;
  for (unsigned int i = 0; i < dim; ++i)
    result[i][dim] = v[i];
  return result;
}

/**
 * This class compares two fields of data by their integrals weighted with a few functions that have
 * no symmetry. The fields are equal if the integrals differ by at most 1e-7 of the integrals of the
 * norms.
 */
template <int dim>
class Comparison
{
public:
  /// @param[in] length Size of the model, for the functions [length].
  explicit Comparison(const double length) : length(length) {}

  /// Add a point @p x of the first field, after the map @p Q, and a point @p y of the second field.
  void add(double                        weight,
           const dealii::Tensor<2, dim> &Q,
           const PointData<dim>         &at_x,
           const dealii::Tensor<1, dim> &x,
           const PointData<dim>         &at_y,
           const dealii::Tensor<1, dim> &y);
  /// Return whether the fields are equal. Collective.
  bool is_equal(MPI_Comm communicator) const;

private:
  const double        length;
  std::vector<double> differences, sizes;
};

/// This class evaluates the conditions of a model at points.
template <int dim>
class Conditions
{
public:
  /// Compute the mean of all nodes. The input must outlive this object. Collective.
  explicit Conditions(const AdviceInput<dim> &input);

  /// Return the mean of all nodes.
  const dealii::Point<dim> &centre() const { return mean; }
  /// Return the maximum distance of a node from the mean [length].
  double size() const { return radius; }

  /// Return the places of the boundary faces of this rank: the centre of each face, and one point
  /// between the centre and each node.
  std::vector<Place<dim>> on_faces() const;
  /// Return the centres of the cells of this rank.
  std::vector<Place<dim>> in_cells() const;

  /// Return the projector on the directions in which supports hold a boundary.
  dealii::Tensor<2, dim> held(const Place<dim> &at) const;
  /// Return the data at a place. All places on faces have data of the same kinds, and so have all
  /// places in cells.
  PointData<dim> data(const Place<dim> &at) const;
  /// Return whether a boundary acts as a symmetry plane: it is held along its normal only, by zero,
  /// and has neither loads nor contact.
  bool is_symmetry_support(const Place<dim> &at) const;

private:
  using Vector = dealii::Tensor<1, dim>;

  void add_loads(const Place<dim> &at, unsigned int load_case, PointData<dim> &data) const;
  void add_contact(const Place<dim> &at, PointData<dim> &data) const;

  const AdviceInput<dim>                              &input;
  dealii::Point<dim>                                   mean;
  double                                               radius = 0.;
  std::vector<geometry::Formula<dim>>                  gaps;      ///< per pair
  std::vector<std::unique_ptr<contact::Obstacle<dim>>> obstacles; ///< per pair, or null
};
} // namespace snug::advice

#endif
