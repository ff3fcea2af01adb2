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
/// Entries of `subsection Obstacle NAME`. Lists have one number per dimension.
struct ObstacleParameters
{
  std::string         name;
  std::string         shape = "plane"; ///< name in obstacle_table()
  std::vector<double> point;           ///< [length]
  std::vector<double> normal, axis;    ///< directions of any length
  double              radius = 1.;     ///< [length]
  std::string         formula;         ///< in x, y, z
  std::vector<double> displacement;    ///< [length]

  std::string section() const { return "Obstacle " + name; }

  void declare(Entries &entries);
  /// Set lists that were left empty to their defaults.
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

/// This class is the interface of a rigid body without a mesh.
template <int dim>
class Obstacle
{
public:
  virtual ~Obstacle() = default;

  /// Return the distance of @p x. Return nothing where the closest point is not unique, as at the
  /// centre of a sphere, or cannot be found.
  virtual std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const = 0;
};

template <int dim>
dealii::Point<dim> to_point(const std::vector<double> &coordinates);

/**
 * Return the table of the shapes of obstacles. Obstacles made by the table may differentiate
 * formulas by difference quotients over a fraction of @p element_size [length].
 */
template <int dim>
const ChoiceTable<std::unique_ptr<Obstacle<dim>>(const ObstacleParameters &parameters,
                                                 double                    element_size)> &
obstacle_table();
} // namespace snug::contact

#endif
