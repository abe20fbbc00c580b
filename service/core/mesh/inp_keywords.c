/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/inp_keywords.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/solid_mesh.h"

static const char WRITTEN_OUT[] = "nodes and elements must be written out one by one";
static const char MASSES[] = "left out: the body here is lighter by it";
static const char STRUCTURES[] = "left out: neither its mass nor its stiffness is in the body";
static const char SPRINGS[] = "left out: no spring, damper or joint acts on the body";
static const char TIES[] = "left out: the body here is free of it";

/* in alphabetical order within their kinds */
static const struct {
    const char *name;
    enum keyword_kind kind;
    const char *meaning;
} KEYWORDS[] = {
    {"ELCOPY", KEYWORD_REFUSED, WRITTEN_OUT},
    {"ELGEN", KEYWORD_REFUSED, WRITTEN_OUT},
    {"NCOPY", KEYWORD_REFUSED, WRITTEN_OUT},
    {"NFILL", KEYWORD_REFUSED, WRITTEN_OUT},
    {"NGEN", KEYWORD_REFUSED, WRITTEN_OUT},
    {"NMAP", KEYWORD_REFUSED, WRITTEN_OUT},
    {"PARAMETER", KEYWORD_REFUSED, "numbers must be written out"},
    {"SYSTEM", KEYWORD_REFUSED, WRITTEN_OUT},

    {"BEAMGENERALSECTION", KEYWORD_TOLD, STRUCTURES},
    {"BEAMSECTION", KEYWORD_TOLD, STRUCTURES},
    {"CONNECTORSECTION", KEYWORD_TOLD, SPRINGS},
    {"CONTACTPAIR", KEYWORD_TOLD, TIES},
    {"COUPLING", KEYWORD_TOLD, TIES},
    {"CYCLICSYMMETRYMODEL", KEYWORD_TOLD, "left out: the body is the sector alone"},
    {"DASHPOT", KEYWORD_TOLD, SPRINGS},
    {"DISTRIBUTINGCOUPLING", KEYWORD_TOLD, TIES},
    {"EMBEDDEDELEMENT", KEYWORD_TOLD, TIES},
    {"EQUATION", KEYWORD_TOLD, TIES},
    {"GAP", KEYWORD_TOLD, SPRINGS},
    {"GAPUNIT", KEYWORD_TOLD, SPRINGS},
    {"INERTIARELIEF", KEYWORD_TOLD, TIES},
    {"KINEMATICCOUPLING", KEYWORD_TOLD, TIES},
    {"MEMBRANESECTION", KEYWORD_TOLD, STRUCTURES},
    {"MODELCHANGE", KEYWORD_TOLD, "left out: all elements take part"},
    {"MPC", KEYWORD_TOLD, TIES},
    {"NONSTRUCTURALMASS", KEYWORD_TOLD, MASSES},
    {"PRETENSIONSECTION", KEYWORD_TOLD, "left out: the body has no prestress here"},
    {"REBAR", KEYWORD_TOLD, STRUCTURES},
    {"RIGIDBODY", KEYWORD_TOLD, "left out: the body is elastic throughout"},
    {"ROTARYINERTIA", KEYWORD_TOLD, "left out: masses on nodes have no inertia of their own here"},
    {"SHELLGENERALSECTION", KEYWORD_TOLD, STRUCTURES},
    {"SHELLSECTION", KEYWORD_TOLD, STRUCTURES},
    {"SPRING", KEYWORD_TOLD, SPRINGS},
    {"SUBMODEL", KEYWORD_TOLD, TIES},
    {"TIE", KEYWORD_TOLD, TIES},

    {"BRITTLECRACKING", KEYWORD_LAW, NULL},
    {"CAPPLASTICITY", KEYWORD_LAW, NULL},
    {"CASTIRONPLASTICITY", KEYWORD_LAW, NULL},
    {"COMPRESSIONONLY", KEYWORD_LAW, NULL},
    {"CONCRETE", KEYWORD_LAW, NULL},
    {"CONCRETEDAMAGEDPLASTICITY", KEYWORD_LAW, NULL},
    {"CREEP", KEYWORD_LAW, NULL},
    {"CRUSHABLEFOAM", KEYWORD_LAW, NULL},
    {"CYCLICHARDENING", KEYWORD_LAW, NULL},
    {"DAMAGEINITIATION", KEYWORD_LAW, NULL},
    {"DAMPING", KEYWORD_LAW, NULL},
    {"DEFORMATIONPLASTICITY", KEYWORD_LAW, NULL},
    {"DRUCKERPRAGER", KEYWORD_LAW, NULL},
    {"EOS", KEYWORD_LAW, NULL},
    {"FLUIDCONSTANTS", KEYWORD_LAW, NULL},
    {"HYPERELASTIC", KEYWORD_LAW, NULL},
    {"HYPERFOAM", KEYWORD_LAW, NULL},
    {"HYPOELASTIC", KEYWORD_LAW, NULL},
    {"MOHRCOULOMB", KEYWORD_LAW, NULL},
    {"POROUSELASTIC", KEYWORD_LAW, NULL},
    {"RATEDEPENDENT", KEYWORD_LAW, NULL},
    {"TENSIONONLY", KEYWORD_LAW, NULL},
    {"USERMATERIAL", KEYWORD_LAW, NULL},
    {"VISCOELASTIC", KEYWORD_LAW, NULL},

    {"AMPLITUDE", KEYWORD_HARMLESS, NULL},
    {"CHANGEFRICTION", KEYWORD_HARMLESS, NULL},
    {"CLEARANCE", KEYWORD_HARMLESS, NULL},
    {"CONDUCTIVITY", KEYWORD_HARMLESS, NULL},
    {"CONTACTCONTROLS", KEYWORD_HARMLESS, NULL},
    {"CONTROLS", KEYWORD_HARMLESS, NULL},
    {"DEPVAR", KEYWORD_HARMLESS, NULL},
    {"DISTRIBUTION", KEYWORD_HARMLESS, NULL},
    {"DISTRIBUTIONTABLE", KEYWORD_HARMLESS, NULL},
    {"ELECTRICALCONDUCTIVITY", KEYWORD_HARMLESS, NULL},
    {"ELFILE", KEYWORD_HARMLESS, NULL},
    {"ENDSTEP", KEYWORD_HARMLESS, NULL},
    {"EXPANSION", KEYWORD_HARMLESS, NULL},
    {"FRICTION", KEYWORD_HARMLESS, NULL},
    {"GAPCONDUCTANCE", KEYWORD_HARMLESS, NULL},
    {"HEADING", KEYWORD_HARMLESS, NULL},
    {"HOURGLASSSTIFFNESS", KEYWORD_HARMLESS, NULL},
    {"MAGNETICPERMEABILITY", KEYWORD_HARMLESS, NULL},
    {"NODALTHICKNESS", KEYWORD_HARMLESS, NULL},
    {"NODEFILE", KEYWORD_HARMLESS, NULL},
    {"NODEOUTPUT", KEYWORD_HARMLESS, NULL},
    {"NORMAL", KEYWORD_HARMLESS, NULL},
    {"ORIENTATION", KEYWORD_HARMLESS, NULL},
    {"OUTPUT", KEYWORD_HARMLESS, NULL},
    {"PHYSICALCONSTANTS", KEYWORD_HARMLESS, NULL},
    {"PREPRINT", KEYWORD_HARMLESS, NULL},
    {"RESTART", KEYWORD_HARMLESS, NULL},
    {"SECTIONCONTROLS", KEYWORD_HARMLESS, NULL},
    {"SPECIFICGASCONSTANT", KEYWORD_HARMLESS, NULL},
    {"SPECIFICHEAT", KEYWORD_HARMLESS, NULL},
    {"SURFACEBEHAVIOR", KEYWORD_HARMLESS, NULL},
    {"SURFACEINTERACTION", KEYWORD_HARMLESS, NULL},
    {"TIMEPOINTS", KEYWORD_HARMLESS, NULL},
    {"TRANSFORM", KEYWORD_HARMLESS, NULL},
    {"USEROUTPUTVARIABLES", KEYWORD_HARMLESS, NULL},
    {"VALUESATINFINITY", KEYWORD_HARMLESS, NULL},
    {"VIEWFACTOR", KEYWORD_HARMLESS, NULL},
};

/* keywords whose parameters make nodes, elements, sets and materials; those with = have values */
static const struct {
    const char *name, *keys;
} PARAMETERS[] = {
    {"ASSEMBLY", "NAME="},
    {"DENSITY", "DEPENDENCIES= INPUT= POREFLUID"},
    {"ELASTIC", "COMPRESSIONFACTOR= DEPENDENCIES= INPUT= MODULI= TYPE="},
    {"ELEMENT", "ELSET= FILE= INPUT= OFFSET= SOLIDELEMENTNUMBERING= TYPE="},
    {"ELSET", "ELSET= GENERATE INPUT= INSTANCE= INTERNAL UNSORTED"},
    {"INCLUDE", "INPUT= PASSWORD="},
    {"INSTANCE", "INSTANCE= LIBRARY= NAME= PART="},
    {"MASS", "ALPHA= COMPOSITE= ELSET= INPUT= ORIENTATION= TYPE="},
    {"MATERIAL", "NAME= RTOL= SRATEFACTOR= SRATETYPE= STRAINRATEREGULARIZATION= UNSYMM"},
    {"NODE", "INPUT= NSET= SYSTEM="},
    {"NSET", "ELSET= GENERATE INPUT= INSTANCE= INTERNAL NSET= UNSORTED"},
    {"PART", "INTERNAL NAME="},
    {"PLASTIC", "DATATYPE= DEPENDENCIES= EXTRAPOLATION= HARDENING= INPUT= NUMBERBACKSTRESSES= "
                "PROPERTIES= RATE= SCALESTRESS="},
    {"SOLIDSECTION", "COMPOSITE CONTROLS= ELSET= INPUT= LAYUP= MATERIAL= NODALTHICKNESS ORDER= "
                     "ORIENTATION= REFNODE= STACKDIRECTION= SYMMETRIC THICKNESS="},
    {"SURFACE", "COMBINE= CROP CUTTINGSURFACE DEFINITION= FILLRADIUS= INPUT= INTERNAL MAXRATIO= "
                "NAME= NOOFFSET NOTHICK PROPERTY= REGIONTYPE= SCALETHICK= TRIM= TYPE= USER"},
};

/* the word `key` in a list of words, with or without = behind it */
static enum keyword_parameter_kind find_key(const char *keys, const char *key)
{
    size_t length = strlen(key);
    for (const char *word = keys; *word;) {
        size_t size = strcspn(word, " "), letters = strcspn(word, " =");
        if (letters == length && strncmp(word, key, length) == 0)
            return letters < size ? PARAMETER_VALUE : PARAMETER_FLAG;
        word += size + (word[size] == ' ');
    }
    return PARAMETER_UNKNOWN;
}

enum keyword_parameter_kind keyword_parameter(const char *name, const char *key)
{
    for (size_t i = 0; i < sizeof PARAMETERS / sizeof *PARAMETERS; i++)
        if (strcmp(PARAMETERS[i].name, name) == 0)
            return find_key(PARAMETERS[i].keys, key);
    return PARAMETER_FREE;
}

enum keyword_kind keyword_find(const char *name, const char **meaning)
{
    for (size_t i = 0; i < sizeof KEYWORDS / sizeof *KEYWORDS; i++)
        if (strcmp(KEYWORDS[i].name, name) == 0) {
            *meaning = KEYWORDS[i].meaning;
            return KEYWORDS[i].kind;
        }
    return KEYWORD_UNKNOWN;
}

bool keyword_find_in_step(const char *name, const char **meaning)
{
    static const char *const STATIC[] = {"STATIC", "VISCO", "COUPLEDTEMPERATURE-DISPLACEMENT"};
    if (strcmp(name, "MODELCHANGE") == 0 || strcmp(name, "INCLUDE") == 0) {
        *meaning = name[0] == 'M' ? "left out: all elements take part"
                                  : "left out: a step says nothing of the body";
        return true;
    }
    for (size_t i = 0; i < sizeof STATIC / sizeof *STATIC; i++)
        if (strcmp(name, STATIC[i]) == 0) {
            *meaning = "the body here is unloaded, without the stiffness of such a prestress";
            return true;
        }
    return false;
}

bool keyword_replaces_elastic(const char *name)
{
    static const char *const LAWS[] = {"DEFORMATIONPLASTICITY", "EOS",         "FLUIDCONSTANTS",
                                       "HYPERELASTIC",          "HYPERFOAM",   "HYPOELASTIC",
                                       "POROUSELASTIC",         "USERMATERIAL"};
    for (size_t i = 0; i < sizeof LAWS / sizeof *LAWS; i++)
        if (strcmp(name, LAWS[i]) == 0)
            return true;
    return false;
}

size_t keyword_solid_nodes(const char *type)
{
    for (const char *at = type; *at; at++)
        if (at[0] == '3' && (at[1] == 'D' || at[1] == 'd') && isdigit((unsigned char)at[2])) {
            unsigned long count = strtoul(at + 2, NULL, 10);
            return count >= 10 && count <= ELEMENT_MOST_NODES ? count : 0;
        }
    return 0;
}

bool keyword_is_surface(const char *type)
{
    static const char *const KINDS[] = {"S",   "STRI", "CPS", "CPE", "CAX", "M3D",
                                        "R3D", "SFM",  "T2D", "T3D", "B2",  "B3"};
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i++) {
        size_t length = strlen(KINDS[i]);
        if (strncasecmp(type, KINDS[i], length) == 0 &&
            (length > 1 || (type[1] >= '0' && type[1] <= '9')))
            return true;
    }
    return false;
}
