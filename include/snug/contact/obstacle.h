#ifndef snug_contact_obstacle_h
#define snug_contact_obstacle_h

#include <snug/base/choice.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::contact {
/// Entries of `subsection Obstacle NAME`; lists have a number per
/// dimension.
struct ObstacleParameters
{
  std::string         name;
  std::string         shape = "plane"; ///< name in obstacle_table()
  std::vector<double> point;           ///< [length]
  std::vector<double> normal, axis;    ///< directions of any length
  double              radius = 1.;     ///< [length]
  std::string         formula;         ///< of x, y, z
  std::vector<double> displacement;    ///< [length]

  std::string section() const { return "Obstacle " + name; }

  void declare(Entries &entries);
  /// Give lists that were left empty their defaults.
  void complete(unsigned int dimension);
  void check(const SectionCheck &section) const;
};

/// Signed distance d to an obstacle, positive outside, with derivatives.
template <int dim>
struct ObstacleDistance
{
  double                 value;    ///< [length]
  dealii::Tensor<1, dim> gradient; ///< unit, out of the obstacle
  dealii::Tensor<2, dim> hessian;  ///< [1 / length]
};

/// A rigid body without a mesh.
template <int dim>
class Obstacle
{
public:
  virtual ~Obstacle() = default;

  /// Nothing where the closest point is not unique, like at the centre of
  /// a sphere, or cannot be found.
  virtual std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const = 0;
};

template <int dim>
dealii::Point<dim> to_point(const std::vector<double> &coordinates);

/**
 * The shapes of obstacles. What is made of them may take derivatives of
 * formulas by differences over a part of @p element_size [length].
 */
template <int dim>
const ChoiceTable<std::unique_ptr<Obstacle<dim>>(const ObstacleParameters &parameters,
                                                 double                    element_size)> &
obstacle_table();
} // namespace snug::contact

#endif
