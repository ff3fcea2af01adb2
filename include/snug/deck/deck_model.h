#ifndef snug_deck_deck_model_h
#define snug_deck_deck_model_h

#include <snug/deck/deck_bodies.h>
#include <snug/deck/local_axes.h>
#include <snug/deck/remarks.h>

#include <optional>

namespace snug::deck {
/// The materials, supports, loads and contacts of a deck. Sets are named as in DeckBodies, and have
/// been used there. Nodes and elements are indices.
struct DeckModel
{
  struct Material
  {
    std::string           name;
    unsigned long         line;
    std::optional<double> youngs_modulus, poissons_ratio;
    double                density = 0., expansion = 0., yield_stress = 0.;
  };

  /// A displacement component of a set of faces [length].
  struct PrescribedComponent
  {
    std::string   set;
    unsigned int  component; ///< 0, 1, ...: x, y, z, normal, radial, tangential, axial
    double        value;
    unsigned long line;
    unsigned int  step; ///< in which it is given
  };

  /// A number, the line where it stands and the step in which it is given.
  struct Given
  {
    double        value;
    unsigned long line;
    unsigned int  step;
    bool          is_fixed = false; ///< keeps the value of the step before
  };

  /// A pressure (one component) or a traction on a set.
  struct FaceLoad
  {
    std::string         set;
    std::vector<double> components;
    unsigned long       line;
    unsigned int        step;
  };

  /// Gravity of the elements of a set.
  struct Gravity
  {
    std::set<unsigned int> elements;
    std::vector<double>    acceleration;
    unsigned long          line;
    unsigned int           step;
  };

  /// Supports and loads at the end of a step; those of earlier steps continue.
  struct Step
  {
    std::string                      name;
    unsigned long                    line = 0;
    std::vector<PrescribedComponent> prescribed;
    /// node and component -> displacement, at nodes that belong to no face of their set
    std::map<std::pair<unsigned int, unsigned int>, Given> held_nodes;
    std::vector<FaceLoad>                                  pressures, tractions;
    /// node and component -> the forces there
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Given>> point_forces;
    std::vector<Gravity>                                                gravities;
    std::map<unsigned int, Given>                                       temperatures; ///< by node
    /// reference node and component, 0 to 5 with rotations -> displacement of a rigid body
    std::map<std::pair<unsigned int, unsigned int>, Given> motions;
    /// reference node and component -> the forces and moments there
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Given>> reference_loads;
  };

  /// A spring between a node and the ground, along an axis [force / length].
  struct Spring
  {
    unsigned int  node, component;
    double        stiffness;
    unsigned long line;
  };

  struct Interaction
  {
    std::string name; ///< in upper case
    double      friction = 0.;
    bool        is_tied  = false; ///< PRESSURE-OVERCLOSURE=TIED
  };

  /// Followers of a reference node: a rigid body of faces that belong to no cell or of an
  /// analytical surface, or faces of bodies, which are rigid or carry the loads of the node.
  struct RigidBody
  {
    unsigned int                        reference_node;
    std::set<std::vector<unsigned int>> faces;   ///< sorted corners
    std::string                         surface; ///< name of the analytical surface, or ""
    unsigned long                       line;
    std::string                         set    = {}; ///< of faces; "": all faces of the bodies
    std::vector<unsigned int>           bodies = {}; ///< with such faces
    bool                                is_distributing = false;
    std::set<unsigned int>              components      = {}; ///< of distributed loads, 0 to 5
  };

  /// A rigid body as an obstacle. Vectors have one number per dimension.
  struct Obstacle
  {
    std::string         name;
    std::string         shape;     ///< plane, sphere, hollow cylinder, ...
    std::vector<double> point;     ///< of the plane or the axis, or the centre [length]
    std::vector<double> direction; ///< normal of a plane, axis of a cylinder; empty for spheres
    double              radius;    ///< [length]
    unsigned int        rigid_body;
  };

  /// A contact of two sets of faces on one body each.
  struct Contact
  {
    std::string                 slave, master;
    unsigned int                slave_body, master_body;
    std::string                 interaction; ///< in upper case, or ""
    double                      gap;         ///< added to that of the mesh [length]
    unsigned long               line;
    std::optional<unsigned int> obstacle   = {};    ///< master side, instead of a body
    bool                        is_general = false; ///< any side may be the slave side
    double                      reach      = 0.; ///< of general contact and ties; 0: any [length]
    bool                        is_tied    = false;
  };

  /// A bolt: its tied cut, and the node whose component 0 has its force and shortening.
  struct Bolt
  {
    std::string   name;
    Contact       cut;
    unsigned int  node;
    double        sign; ///< -1 if the force of the node compresses
    unsigned long line;
  };

  std::vector<Material>                materials;
  std::map<unsigned int, std::string>  material_of;   ///< element -> material
  std::map<unsigned int, std::string>  region_of;     ///< element -> set of its section
  std::map<std::string, unsigned long> section_lines; ///< material in upper case -> *SOLID SECTION
  Step                                 initial;       ///< before the first step
  std::vector<Step>                    steps;         ///< in the order of the deck
  std::map<unsigned int, double>       initial_temperatures; ///< by node
  std::vector<Spring>                  springs;
  std::map<unsigned int, LocalAxes::Axes> cylinders; ///< body -> axis of its components 4 to 6
  std::vector<Interaction>                interactions;
  std::vector<Contact>                    contacts;
  std::vector<Bolt>                       bolts;
  std::vector<RigidBody>                  rigid_bodies;
  std::vector<Obstacle>                   obstacles;
  std::optional<double>                   thickness;
  std::string                             model  = "solid";
  unsigned int                            degree = 1;
  std::string                             units; ///< "mm, N", or ""

  /// Return the coefficient of friction of a contact; 0 for ties.
  double friction(const Contact &contact) const
  {
    for (const auto &interaction : interactions)
      if (!contact.is_tied && interaction.name == contact.interaction && interaction.friction > 0.)
        return interaction.friction;
    return 0.;
  }
};

/// Read the keywords of a deck. Keywords and options that are not read are noted in @p remarks.
/// @throws InputError "line 17: message".
DeckModel read_model(const mesh_file::DeckText &text,
                     const mesh_file::DeckMesh &deck,
                     DeckBodies                &bodies,
                     Remarks                   &remarks);
} // namespace snug::deck

#endif
