#ifndef snug_contact_pair_h
#define snug_contact_pair_h

#include <snug/contact/obstacle.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::contact {
/// Method of contact between two faces.
enum class Method
{
  nodal,
  mortar
};
inline Names names(Method)
{
  return {{"nodal", "slave nodes against the points of master faces whose normals lead to them. "
                    "Forces are reduced to zero from "
                    "the edge of the master side to 5 % of a face beyond it."},
          {"mortar",
           "mean gaps around slave nodes, integrated over both faces, for non-matching meshes"}};
}

enum class Slave
{
  /// side that ends inside the other one; otherwise side of the smaller faces, or, of unequal faces
  /// with mortar rows, side of the larger faces
  finer,
  first ///< side that is named first
};
inline Names names(Slave)
{
  return {
    {"finer",
     "side that ends inside the other one where both may touch, if only one does, unless it has "
     "far finer faces or is far stiffer (size of the other faces over its faces, times its Young's "
     "modulus over the other one, above 5); otherwise "
     "side with the smaller mean face size; for mortar contact, side with the larger mean face "
     "size if h E > 1.5, where h is the ratio of the face sizes (larger over smaller) and E the "
     "ratio of Young's moduli (larger over smaller). Sizes within 10 % count as equal; then "
     "it is the first side."},
    {"first", "side that is named first"}};
}

/// Law of the forces between two sides.
enum class Law
{
  contact,
  tied ///< the sides move together, with forces of any direction
};
inline Names names(Law)
{
  return {{"contact", "pressure, and friction if there is any"},
          {"tied", "the sides stay together as they are, also across a gap, and transmit forces of "
                   "any direction"}};
}

/// Law of the tangential forces of a contact.
enum class Friction
{
  none,
  Tresca,
  Coulomb
};
inline Names names(Friction)
{
  return {{"none", "no tangential forces"},
          {"Tresca", "tangential forces up to Friction bound times the area in contact"},
          {"Coulomb", "tangential forces up to Friction coefficient times the normal force"}};
}

/// Parameters of the contact of two sides: entries of `subsection Contact`, for all pairs, and of
/// `subsection Pair SLAVE: MASTER`.
struct PairParameters
{
  Law                   law = Law::contact;
  std::optional<Method> method; ///< empty: chosen by whether the meshes match
  Slave                 slave = Slave::finer;
  /// maximum distance of slave nodes with a row from the master [length]; 0: no limit
  double search_distance = 0.;
  /// maximum angle between the slave's normal and the row's normal [degrees]
  double      largest_angle = 90.;
  std::string gap           = "0";   ///< formula in x, y, z that is added to gaps [length]
  bool        interference  = false; ///< true: initial overlap is intended
  Friction    friction      = Friction::none;
  /// formulas in x, y, z, read by Coulomb and by Tresca [force/length^2]; empty: not given
  std::string friction_coefficient, friction_bound;

  /// Return the formula that the friction law reads.
  const std::string &resistance() const
  {
    return friction == Friction::Coulomb ? friction_coefficient : friction_bound;
  }
  /// Return whether there may be tangential forces: no friction is the same as a coefficient or a
  /// bound of 0.
  bool has_friction() const;

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;
};

/// Entries of `subsection Contact`.
struct ContactParameters
{
  struct Entry
  {
    std::string    slave;  ///< body.boundary + ...
    std::string    master; ///< body.boundary + ..., or an obstacle
    PairParameters parameters;

    std::string section() const { return "Pair " + slave + ": " + master; }

    void declare(Entries &entries) { parameters.declare(entries); }
  };

  PairParameters     defaults;
  std::vector<Entry> pairs;
  /// maximum number of new contact searches after which an optimization continues
  unsigned int update_pairing = 0;

  void declare(Entries &entries);
};

/// Index of a body and id of one of its boundaries.
using Boundary = std::pair<unsigned int, unsigned int>;

/// One side of a pair: one or several boundaries of a body.
class Side
{
public:
  Side() = default;
  Side(unsigned int body, unsigned int boundary) : members({{body, boundary}}) {}
  Side(const Boundary &boundary) : members({boundary}) {}

  /// Return the boundaries, ascending.
  const std::vector<Boundary> &boundaries() const { return members; }
  /// Return the body of a side that has at least one boundary.
  unsigned int body() const { return members.front().first; }
  void         add(const Boundary &boundary);
  bool         has(const Boundary &boundary) const;

private:
  std::vector<Boundary> members;
};

/// Return whether a face of a mesh or of a surface lies on @p side.
template <typename Face>
bool is_on(const Face &face, const Side &side)
{
  return side.has({face.body, face.boundary});
}

/// One contact pair: a slave side and a master side or obstacle.
struct Pair
{
  Side                              slave, master;
  std::string                       slave_name = {}, master_name = {};
  PairParameters                    parameters = {};
  std::optional<ObstacleParameters> obstacle   = {};
  /// Young's modulus of the softest material of the slave's body over that of the master's body;
  /// infinity or 0 where the slave or the master is a rigid face
  double modulus_ratio = 1.;

  /// Return "slave: master".
  std::string name() const { return slave_name + ": " + master_name; }
};

/// Return the boundaries of all sides of @p pairs, ascending.
std::vector<Boundary> boundaries_of(const std::vector<Pair> &pairs);
} // namespace snug::contact

#endif
