#ifndef snug_contact_pair_h
#define snug_contact_pair_h

#include <string>
#include <utility>
#include <vector>

namespace snug
{
  namespace contact
  {
    /// Entries of `subsection Contact`.
    struct ContactParameters
    {
      /// "body.boundary: body.boundary", slave: master
      std::vector<std::pair<std::string, std::string>> pairs;
      std::string method = "nodal"; ///< name in contact_method_table()
    };

    /// One contact pair as (body, boundary) of slave and master.
    struct Pair
    {
      std::pair<unsigned int, unsigned int> slave, master;
      std::string                           method = "nodal";
      std::string                           name   = {}; ///< for messages
    };
  } // namespace contact
} // namespace snug

#endif
