// All texts that the game writes on the screen, in each of its languages. The English text is the key, as in
// gettext; a key that has no row here does not compile. Command line, log and error messages stay English.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace shoal::game {

enum class Language { English, German, French };

using TextRow = std::array<const char*, 3>; // by Language

// "{}" stands for a number or a name.
inline constexpr auto kTexts = std::to_array<TextRow>({
    // Screens
    {"Dive", "Tauchen", "Plonger"},
    {"Free swim", "Freies Schwimmen", "Nage libre"},
    {"My film or photo", "Mein Film oder Foto", "Mon film ou ma photo"},
    {"Headset", "Headset", "Casque"},
    {"Settings", "Einstellungen", "Réglages"},
    {"How to play", "Spielanleitung", "Comment jouer"},
    {"Field guide", "Bestimmungsbuch", "Guide des espèces"},
    {"Quit", "Beenden", "Quitter"},
    {"Back", "Zurück", "Retour"},
    {"Paused", "Pause", "Pause"},
    {"Resume", "Weiter", "Reprendre"},
    {"Start again", "Neu beginnen", "Recommencer"},
    {"Title screen", "Startbildschirm", "Écran-titre"},
    {"Photo mode", "Fotomodus", "Mode photo"},
    {"Dive again", "Noch einmal tauchen", "Replonger"},
    {"The dive is over: {}", "Der Tauchgang ist zu Ende: {}", "La plongée est terminée : {}"},
    {"No clock, no shark: meet the animals.", "Keine Uhr, kein Hai: lerne die Tiere kennen.",
     "Ni chrono ni requin : va à la rencontre des animaux."},
    {"Choose a dive", "Wähle einen Tauchgang", "Choisis une plongée"},
    {"Loading", "Wird geladen", "Chargement"},
    {"Fish in the light of a film", "Fische im Licht eines Films", "Des poissons dans la lumière d’un film"},

    // Results
    {"Stars in all: {}", "Sterne insgesamt: {}", "Étoiles en tout : {}"},
    {"new", "neu", "nouveau"},
    {"record", "Rekord", "record"},
    {"{} fish caught", "{} Fische gefangen", "{} poissons attrapés"},
    {"1 fish caught", "1 Fisch gefangen", "1 poisson attrapé"},
    {"{} taken by the shark", "{} vom Hai geraubt", "{} volés par le requin"},
    {"Your best dive yet", "Dein bester Tauchgang bisher", "Ta meilleure plongée"},
    {"Your best dives before: {}", "Deine besten Tauchgänge zuvor: {}",
     "Tes meilleures plongées jusqu’ici : {}"},
    {"Better than last time by {}", "{} mehr als beim letzten Mal", "{} de mieux que la dernière fois"},
    {"Seed {}", "Startwert {}", "Graine {}"},
    {"Catch {} fish", "Fange {} Fische", "Attrape {} poissons"},
    {"Catch {} {}", "Fange {} {}", "Attrape {} {}"},
    {"goal reached", "Ziel erreicht", "objectif atteint"},
    {"Catch {} different species", "Fange {} verschiedene Arten", "Attrape {} espèces différentes"},
    {"Score {} points", "Erreiche {} Punkte", "Marque {} points"},
    {"Catch {} fish and lose none to the shark", "Fange {} Fische und verliere keinen an den Hai",
     "Attrape {} poissons sans que le requin t’en prenne un"},
    {"Catch {} fish within {} seconds", "Fange {} Fische in {} Sekunden",
     "Attrape {} poissons en {} secondes"},
    {"First catch: {}", "Erster Fang: {}", "Première prise : {}"},
    {"Catch {} fish with each hand", "Fange mit jeder Hand {} Fische", "Attrape {} poissons de chaque main"},
    {"Bring fish to feed on a mussel", "Locke mit einer Muschel Fische an",
     "Attire des poissons avec une moule"},
    {"Bring fish to feed on {} mussels", "Locke mit {} Muscheln Fische an",
     "Attire des poissons avec {} moules"},
    {"Turn the shark away with a stone", "Vertreibe den Hai mit einem Stein",
     "Fais fuir le requin avec une pierre"},
    {"Turn the shark away with stones: {}", "Vertreibe den Hai mit Steinen: {}",
     "Fais fuir le requin avec des pierres : {}"},
    {"Take {} {} out of the sea", "Hole {} {} aus dem Meer", "Sors {} {} de la mer"},
    {"Touch {} kinds of animals", "Berühre {} Tierarten", "Touche {} espèces d’animaux"},
    {"Catch {} fish in a row and frighten none in between",
     "Fange {} Fische in Folge, ohne einen zu verscheuchen",
     "Attrape {} poissons d’affilée sans en effrayer un seul"},
    {"Catch {} different species in a row", "Fange {} verschiedene Arten in Folge",
     "Attrape {} espèces différentes d’affilée"},

    // In the dive
    {"{} caught", "{} gefangen", "{} attrapés"},
    {"Reach for a fish and close your hand on it", "Greif nach einem Fisch und schließe die Hand um ihn",
     "Tends la main vers un poisson et ferme-la sur lui"},
    {"Hold it for a second", "Halte ihn eine Sekunde lang fest", "Tiens-le pendant une seconde"},
    {"Keep what you hold away from the shark", "Halte deinen Fang vom Hai fern",
     "Garde ta prise loin du requin"},
    {"A fast hand frightens fish", "Eine schnelle Hand verscheucht Fische",
     "Une main rapide effraie les poissons"},
    {"Wait in a fish’s way with an open hand", "Warte mit offener Hand auf dem Weg eines Fischs",
     "Attends, main ouverte, sur le chemin d’un poisson"},
    {"Click: picture. Right button: look. {}: move. Wheel: zoom. Esc: back",
     "Klick: Bild. Rechte Taste: umsehen. {}: bewegen. Mausrad: Zoom. Esc: zurück",
     "Clic : photo. Bouton droit : regarder. {} : bouger. Molette : zoom. Échap : retour"},
    {"A: picture. Left stick: look. Right stick: move. B: back",
     "A: Bild. Linker Stick: umsehen. Rechter Stick: bewegen. B: zurück",
     "A : photo. Stick gauche : regarder. Stick droit : bouger. B : retour"},
    {"Left stick", "Linker Stick", "Stick gauche"},
    {"Right stick, slowly: a fast hand frightens fish",
     "Rechter Stick, langsam: Eine schnelle Hand verscheucht Fische",
     "Stick droit, lentement : une main rapide effraie les poissons"},
    {"Hold the right trigger for one second", "Halte den rechten Trigger eine Sekunde lang",
     "Tiens la gâchette droite pendant une seconde"},
    {"Look around", "Sieh dich um", "Regarde autour de toi"},
    {"Turn your head", "Dreh den Kopf", "Tourne la tête"},
    {"Arrow keys, or hold the right mouse button and move",
     "Pfeiltasten, oder rechte Maustaste halten und bewegen",
     "Flèches, ou tiens le bouton droit et bouge la souris"},
    {"Reach for a fish until it glows", "Greif nach einem Fisch, bis er leuchtet",
     "Tends la main vers un poisson jusqu’à ce qu’il s’illumine"},
    {"Move the mouse slowly: a fast hand frightens fish",
     "Bewege die Maus langsam: Eine schnelle Hand verscheucht Fische",
     "Bouge la souris lentement : une main rapide effraie les poissons"},
    {"Move slowly: a fast hand frightens fish", "Bewege dich langsam: Eine schnelle Hand verscheucht Fische",
     "Bouge lentement : une main rapide effraie les poissons"},
    {"Close your hand and hold the fish", "Schließe die Hand und halte den Fisch",
     "Ferme la main et tiens le poisson"},
    {"Hold the left mouse button for one second", "Halte die linke Maustaste eine Sekunde lang",
     "Tiens le bouton gauche de la souris pendant une seconde"},
    {"For one second", "Eine Sekunde lang", "Pendant une seconde"},
    {"Well caught! Now for real: 90 seconds", "Gut gefangen! Jetzt gilt es: 90 Sekunden",
     "Bien attrapé ! Maintenant pour de vrai : 90 secondes"},
    {"Skip the first steps", "Erste Schritte überspringen", "Passer les premiers pas"},
    {"Show the first steps", "Erste Schritte zeigen", "Montrer les premiers pas"},
    {"Sound {} %", "Ton {} %", "Son {} %"},
    {"New in your field guide: {}", "Neu in deinem Bestimmungsbuch: {}", "Nouveau dans ton guide : {}"},
    {"Fish swim past you and see you. Touch them; the field guide remembers whom you have met.",
     "Fische schwimmen vorbei und sehen dich an. Berühre sie; das Bestimmungsbuch merkt sich, wen du "
     "getroffen hast.",
     "Les poissons passent et te regardent. Touche-les ; le guide retient ceux que tu as rencontrés."},

    // Notices
    {"Hands: {}", "Hände: {}", "Mains : {}"},
    {"{} is not there; the mouse has the hands", "{} ist nicht da; die Maus führt die Hände",
     "{} est absent ; la souris guide les mains"},
    {"The headset does not see where you are: you can look around",
     "Das Headset sieht nicht, wo du bist: Du kannst dich umsehen",
     "Le casque ne voit pas où tu es : tu peux regarder autour de toi"},
    {"To find your hands before the webcam, run once: {}",
     "Damit die Webcam deine Hände findet, führe einmal aus: {}",
     "Pour que la webcam trouve tes mains, exécute une fois : {}"},
    {"The film is damaged here; its last good picture stays",
     "Der Film ist hier beschädigt; sein letztes gutes Bild bleibt stehen",
     "Le film est abîmé ici ; sa dernière bonne image reste"},
    {"The live video has stopped; its last picture stays",
     "Das Live-Video ist stehen geblieben; sein letztes Bild bleibt",
     "La vidéo en direct s’est arrêtée ; sa dernière image reste"},
    {"The live video was lost; its last picture stays until it comes back",
     "Das Live-Video ist abgerissen; sein letztes Bild bleibt, bis es wiederkommt",
     "La vidéo en direct est perdue ; sa dernière image reste jusqu’à son retour"},
    {"Saved, with a picture of all directions: {}", "Gespeichert, dazu ein Bild rundum: {}",
     "Enregistré, avec une image à 360 degrés : {}"},
    {"Not saved: {}", "Nicht gespeichert: {}", "Pas enregistré : {}"},
    {"This headset cannot show your own room", "Dieses Headset kann dein Zimmer nicht zeigen",
     "Ce casque ne peut pas montrer ta pièce"},

    // Performance
    {"frame {} ms median, {} worst of 120", "Bild {} ms im Mittel, {} am längsten von 120",
     "image {} ms médiane, {} au pire de 120"},
    {"light {} ms, decode {} ms (own thread)", "Licht {} ms, Decodieren {} ms (eigener Thread)",
     "lumière {} ms, décodage {} ms (fil séparé)"},
    {"upload {} ms, simulation {} ms", "Hochladen {} ms, Simulation {} ms", "envoi {} ms, simulation {} ms"},
    {"{} {} ms on the graphics side", "{} {} ms auf der Grafikseite", "{} {} ms côté graphique"},
    {"draws {}, triangles {}", "Zeichenaufrufe {}, Dreiecke {}", "appels {}, triangles {}"},
    {"drawn at {} % of the size, light every {} of the video’s frames",
     "mit {} % der Größe gezeichnet, Licht mit jedem {}. Bild des Videos",
     "dessiné à {} % de la taille, lumière toutes les {} images"},
    {"light: {}", "Licht: {}", "lumière : {}"},
    {"What the webcam sees; it stays on this machine", "Was die Webcam sieht; es bleibt auf diesem Gerät",
     "Ce que voit la webcam ; rien ne quitte cet appareil"},
    {"as measured, GGX prefiltered", "wie gemessen, GGX-vorgefiltert", "telle que mesurée, préfiltrée GGX"},
    {"decoded sRGB, clipped light estimated, GGX prefiltered",
     "sRGB dekodiert, abgeschnittenes Licht geschätzt, GGX-vorgefiltert",
     "sRGB décodé, lumière écrêtée estimée, préfiltrée GGX"},
    {"decoded sRGB, GGX prefiltered", "sRGB dekodiert, GGX-vorgefiltert", "sRGB décodé, préfiltrée GGX"},
    {"thesis inverse tone mapping, GGX prefiltered",
     "inverse Tonabbildung der Masterarbeit, GGX-vorgefiltert",
     "mappage tonal inverse du mémoire, préfiltrée GGX"},
    {"background", "Hintergrund", "arrière-plan"},
    {"objects", "Objekte", "objets"},
    {"particles", "Teilchen", "particules"},
    {"shadows", "Schatten", "ombres"},
    {"overlay", "Schrift", "texte"},

    // How to play
    {"Reach with the mouse. When a fish glows, hold the left button: your hand closes. Hold the fish for a "
     "second, and it counts.",
     "Greif mit der Maus. Leuchtet ein Fisch auf, halte die linke Taste gedrückt: Deine Hand schließt sich. "
     "Halte den Fisch eine Sekunde, dann zählt er.",
     "Tends la main avec la souris. Quand un poisson s’illumine, tiens le bouton gauche : ta main se ferme. "
     "Tiens le poisson une seconde, et il compte."},
    {"The wheel reaches nearer or farther. Look around with the arrow keys or with the right button held. "
     "Tab swaps hands.",
     "Das Mausrad greift näher oder weiter. Umsehen: mit den Pfeiltasten oder mit gedrückter rechter Taste. "
     "Tab wechselt die Hand.",
     "La molette tend la main plus près ou plus loin. Regarde autour de toi avec les flèches ou le bouton "
     "droit. Tab change de main."},
    {"With a gamepad the left stick looks, the right stick reaches and the right trigger closes your hand.",
     "Mit dem Gamepad siehst du dich mit dem linken Stick um, greifst mit dem rechten und schließt die Hand "
     "mit dem rechten Trigger.",
     "À la manette : le stick gauche regarde, le stick droit tend la main, la gâchette droite la ferme."},
    {"Fish fear a fast hand and are curious of one that rests: move slowly, or wait in their way.",
     "Fische fürchten schnelle Hände und sind neugierig auf ruhige: Bewege dich langsam, oder warte auf "
     "ihrem Weg.",
     "Les poissons craignent une main rapide et sont curieux d’une main au repos : bouge lentement, ou "
     "attends sur leur chemin."},
    {"A mussel that you hold cracks, and fish come to feed. A stone thrown at the shark's head turns it "
     "away. "
     "Take bottles out of the sea.",
     "Eine Muschel, die du hältst, bricht auf, und Fische kommen fressen. Ein Stein an den Kopf des Hais "
     "vertreibt ihn. Hole Flaschen aus dem Meer.",
     "Une moule que tu tiens s’ouvre, et des poissons viennent manger. Une pierre lancée à la tête du requin "
     "le "
     "fait fuir. Sors les bouteilles de la mer."},
    {"The shark is drawn to a struggling fish. When it points at your hand, let go or pull away.",
     "Zappelnde Fische locken den Hai an. Zeigt er auf deine Hand, lass los oder zieh sie weg.",
     "Le requin est attiré par un poisson qui se débat. S’il vise ta main, lâche prise ou écarte-toi."},
    {"Esc, the middle mouse button or Start on a gamepad pauses. All keys: Settings, Keys and buttons.",
     "Esc, die mittlere Maustaste oder Start auf dem Gamepad macht eine Pause. Alle Tasten: Einstellungen, "
     "Tasten und Knöpfe.",
     "Échap, le bouton central de la souris ou Start à la manette met en pause. Toutes les touches : "
     "Réglages, Touches et boutons."},
    {"Different species one after the other count two, three, four and five times. Each dive has three "
     "goals. "
     "Jellyfish sting the hand that closes on them.",
     "Verschiedene Arten nacheinander zählen zwei-, drei-, vier- und fünffach. Jeder Tauchgang hat drei "
     "Ziele. "
     "Quallen brennen die Hand, die sich um sie schließt.",
     "Des espèces différentes à la suite comptent deux, trois, quatre et cinq fois. Chaque plongée a trois "
     "objectifs. Les méduses piquent la main qui se ferme sur elles."},
    {"Close a hand: go on", "Hand schließen: weiter", "Ferme une main : continuer"},
    {"Close both hands: dive again", "Beide Hände schließen: noch einmal tauchen",
     "Ferme les deux mains : replonger"},

    // My film or photo
    {"Drop a 360-degree video or any photo on this window, or choose one of these.",
     "Zieh ein 360-Grad-Video oder irgendein Foto auf dieses Fenster, oder wähle eines von diesen.",
     "Dépose une vidéo à 360 degrés ou une photo sur cette fenêtre, ou choisis parmi celles-ci."},
    {"There are no films or photos in your folders yet.",
     "In deinen Ordnern sind noch keine Filme oder Fotos.",
     "Il n’y a encore ni film ni photo dans tes dossiers."},
    {"All dives are in {}", "Alle Tauchgänge sind in {}", "Toutes les plongées sont dans {}"},
    {"The dive’s own film", "Der Film des Tauchgangs", "Le film de la plongée"},

    // Keys of the menus
    {"Arrow keys and Enter, mouse or gamepad", "Pfeiltasten und Eingabe, Maus oder Gamepad",
     "Flèches et Entrée, souris ou manette"},

    {"Point with a finger and poke, or pull a controller’s trigger",
     "Zeig mit einem Finger und stups, oder zieh den Trigger eines Controllers",
     "Pointe du doigt et appuie, ou presse la gâchette d’une manette"},

    // Pages of settings
    {"Hands", "Hände", "Mains"},
    {"Comfort", "Komfort", "Confort"},
    {"Picture", "Bild", "Image"},
    {"Sound", "Ton", "Son"},
    {"Text and captions", "Text und Untertitel", "Texte et sous-titres"},
    {"Keys and buttons", "Tasten und Knöpfe", "Touches et boutons"},

    // Hand size
    {"Measure my hand", "Meine Hand messen", "Mesurer ma main"},
    {"Hand size", "Handgröße", "Taille de la main"},
    {"Hold one open hand still, palm to the camera and 30 cm away from it, as far as a sheet of A4 paper is "
     "long.",
     "Halte eine offene Hand still, die Handfläche zur Kamera und 30 cm von ihr entfernt, so weit, wie ein "
     "Blatt A4 lang ist.",
     "Tiens une main ouverte immobile, paume vers la caméra et à 30 cm d’elle, la longueur d’une feuille "
     "A4."},
    {"Keep it there", "Halte sie dort", "Garde-la ainsi"},
    {"Nobody’s hand is that small or big: is it 30 cm away?",
     "So klein oder groß ist keine Hand: Ist sie 30 cm entfernt?",
     "Aucune main n’est si petite ou si grande : est-elle à 30 cm ?"},
    {"Your hand has {} % of the usual size.", "Deine Hand hat {} % der üblichen Größe.",
     "Ta main fait {} % de la taille habituelle."},

    // Settings
    {"Hand size (webcam)", "Handgröße (Webcam)", "Taille de la main (webcam)"},
    {"Hand source", "Handquelle", "Suivi des mains"},
    {"Dominant hand", "Haupthand", "Main dominante"},
    {"Skin", "Haut", "Peau"},
    {"Mouse sensitivity", "Mausempfindlichkeit", "Sensibilité de la souris"},
    {"Invert looking up and down", "Blick auf und ab umkehren", "Inverser le regard vertical"},
    {"Close the hand by", "Hand schließen durch", "Fermer la main"},
    {"Help with catching", "Hilfe beim Fangen", "Aide à la prise"},
    {"Help with depth", "Hilfe bei der Tiefe", "Aide à la profondeur"},
    {"Strength of vibration", "Stärke der Vibration", "Force des vibrations"},
    {"Turning", "Drehen", "Rotation"},
    {"Dark edges while turning", "Dunkle Ränder beim Drehen", "Bords sombres en tournant"},
    {"Posture", "Haltung", "Posture"},
    {"seated", "sitzend", "assise"},
    {"standing", "stehend", "debout"},
    {"Reduced motion", "Weniger Bewegung", "Mouvement réduit"},
    {"Drifting particles", "Schwebeteilchen", "Particules en suspension"},
    {"Game speed", "Spieltempo", "Vitesse du jeu"},
    {"Quality", "Qualität", "Qualité"},
    {"Field of view", "Sichtfeld", "Champ de vision"},
    {"Compositing", "Einblendung", "Incrustation"},
    {"Version of the film", "Fassung des Films", "Version du film"},
    {"best", "beste", "meilleure"},
    {"Fullscreen", "Vollbild", "Plein écran"},
    {"Your own room", "Dein Zimmer", "Ta pièce"},
    {"Stereo", "Stereo", "Stéréo"},
    {"Performance", "Leistungsanzeige", "Affichage des performances"},
    {"Volume", "Lautstärke", "Volume"},
    {"Volume of effects", "Lautstärke der Effekte", "Volume des effets"},
    {"Volume of the film", "Lautstärke des Films", "Volume du film"},
    {"Headphones", "Kopfhörer", "Casque audio"},
    {"Captions", "Untertitel", "Sous-titres"},
    {"Size of captions", "Größe der Untertitel", "Taille des sous-titres"},
    {"Text size", "Textgröße", "Taille du texte"},
    {"High contrast", "Hoher Kontrast", "Contraste élevé"},
    {"Language", "Sprache", "Langue"},

    // Keys and buttons
    {"Close the hand", "Hand schließen", "Fermer la main"},
    {"Look to the left", "Nach links sehen", "Regarder à gauche"},
    {"Look to the right", "Nach rechts sehen", "Regarder à droite"},
    {"Look up", "Nach oben sehen", "Regarder en haut"},
    {"Look down", "Nach unten sehen", "Regarder en bas"},
    {"Reach farther", "Weiter greifen", "Tendre plus loin"},
    {"Reach nearer", "Näher greifen", "Tendre plus près"},
    {"Swap hands", "Hand wechseln", "Changer de main"},
    {"Look ahead again", "Wieder nach vorn sehen", "Regarder devant soi"},
    {"Pause", "Pause", "Pause"},
    {"Louder", "Lauter", "Plus fort"},
    {"Quieter", "Leiser", "Moins fort"},
    {"Press a key or a button for: {}. Esc: leave it",
     "Drücke eine Taste oder einen Knopf für: {}. Esc: so lassen",
     "Appuie sur une touche ou un bouton pour : {}. Échap : ne rien changer"},
    {"It was taken from: {}, which keeps {}", "Bisher hatte sie: {}; es bleibt {}",
     "Elle servait à : {} ; il reste {}"},
    {"It was taken from: {}, which has no key or button now",
     "Bisher hatte sie: {}; dafür gibt es nun keine Taste mehr",
     "Elle servait à : {}, qui n’a plus de touche"},
    {"Reset all keys", "Alle Tasten zurücksetzen", "Réinitialiser les touches"},

    // Names of keys; those with one letter or a number need none
    {"Space", "Leertaste", "Espace"},
    {"Escape", "Esc", "Échap"},
    {"Enter", "Eingabe", "Entrée"},
    {"Tab", "Tab", "Tab"},
    {"Backspace", "Rücktaste", "Retour arrière"},
    {"Insert", "Einfg", "Inser"},
    {"Delete", "Entf", "Suppr"},
    {"Right", "Rechts", "Droite"},
    {"Left", "Links", "Gauche"},
    {"Down", "Ab", "Bas"},
    {"Up", "Auf", "Haut"},
    {"PageUp", "Bild auf", "Page haut"},
    {"PageDown", "Bild ab", "Page bas"},
    {"Home", "Pos1", "Début"},
    {"End", "Ende", "Fin"},
    {"Plus", "Plus", "Plus"},
    {"Minus", "Minus", "Moins"},
    {"Keypad+", "Ziffernblock +", "Pavé +"},
    {"Keypad-", "Ziffernblock -", "Pavé -"},
    {"KeypadEnter", "Ziffernblock Eingabe", "Pavé Entrée"},
    {"LeftShift", "Umschalt links", "Maj gauche"},
    {"RightShift", "Umschalt rechts", "Maj droite"},
    {"LeftControl", "Strg links", "Ctrl gauche"},
    {"RightControl", "Strg rechts", "Ctrl droite"},
    {"LeftAlt", "Alt links", "Alt gauche"},
    {"RightAlt", "Alt rechts", "Alt droite"},
    {"PadUp", "Kreuz auf", "Croix haut"},
    {"PadRight", "Kreuz rechts", "Croix droite"},
    {"PadDown", "Kreuz ab", "Croix bas"},
    {"PadLeft", "Kreuz links", "Croix gauche"},

    // Values of settings
    {"on", "an", "oui"},
    {"off", "aus", "non"},
    {"auto", "automatisch", "automatique"},
    {"mouse", "Maus", "souris"},
    {"leap", "Leap Motion", "Leap Motion"},
    {"webcam", "Webcam", "webcam"},
    {"left", "links", "gauche"},
    {"right", "rechts", "droite"},
    {"light", "hell", "claire"},
    {"medium", "mittel", "moyenne"},
    {"dark", "dunkel", "foncée"},
    {"glove", "Handschuh", "gant"},
    {"hold", "Halten", "maintenir"},
    {"toggle", "Umschalten", "basculer"},
    {"none", "keine", "aucune"},
    {"normal", "normal", "normale"},
    {"strong", "stark", "forte"},
    {"smooth", "gleitend", "continue"},
    {"snap", "in Schritten", "par paliers"},
    {"fixed", "fest", "fixe"},
    {"plain", "einfach", "simple"},
    {"resolution", "Filmauflösung", "résolution du film"},
    {"camera", "wie gefilmt", "comme filmé"},
    {"sbs", "nebeneinander", "côte à côte"},
    {"small", "klein", "petite"},
    {"large", "groß", "grande"},
    {"english", "English", "English"},
    {"german", "Deutsch", "Deutsch"},
    {"french", "Français", "Français"},

    // Captions
    {"a fish flees", "ein Fisch flieht", "un poisson s’enfuit"},
    {"caught", "gefangen", "attrapé"},
    {"it slips away", "er entgleitet", "il s’échappe"},
    {"it struggles", "er zappelt", "il se débat"},
    {"something large passes", "etwas Großes zieht vorbei", "quelque chose de grand passe"},
    {"the last seconds", "die letzten Sekunden", "les dernières secondes"},
    {"the shark is near", "der Hai ist nah", "le requin est proche"},
    {"the shark bumps you", "der Hai rempelt dich an", "le requin te heurte"},
    {"the shark bites", "der Hai beißt zu", "le requin mord"},
    {"the dive begins", "der Tauchgang beginnt", "la plongée commence"},
    {"the dive is over", "der Tauchgang ist zu Ende", "la plongée est terminée"},
    {"too far", "zu weit weg", "trop loin"},
    {"too fast", "zu schnell", "trop rapide"},
    {"closed too early", "zu früh geschlossen", "fermée trop tôt"},
    {"behind it", "dahinter", "derrière lui"},
    {"it stings", "es brennt", "ça pique"},
    {"the mussel cracks", "die Muschel bricht auf", "la moule s’ouvre"},
    {"fish come to feed", "Fische kommen fressen", "des poissons viennent manger"},
    {"no fish is near enough to feed", "kein Fisch ist nah genug, um zu fressen",
     "aucun poisson n’est assez près pour manger"},
    {"the shark turns away", "der Hai dreht ab", "le requin se détourne"},
    {"out of the sea", "aus dem Meer geholt", "sortie de la mer"},
    {"a whale sings", "ein Wal singt", "une baleine chante"},

    // Field guide
    {"You have met {} of {} animals. Touch an animal in the water to get to know it.",
     "Du kennst {} von {} Tieren. Berühre ein Tier im Wasser, um es kennenzulernen.",
     "Tu connais {} animaux sur {}. Touche un animal dans l’eau pour le découvrir."},

    {"{} stars bring it to you. Dive: {}", "Ab {} Sternen kommt es zu dir. Tauchgang: {}",
     "À partir de {} étoiles, il vient à toi. Plongée : {}"},
    {"Next", "Nächstes Tier", "Suivant"},
    {"Previous", "Voriges Tier", "Précédent"},
    {"Caught: {}", "Gefangen: {}", "Prises : {}"},
    {"Longest: {}", "Längster Fang: {}", "La plus longue : {}"},
    {"First met: {}, {}", "Erste Begegnung: {}, {}", "Première rencontre : {}, {}"},

    // Dives
    {"The reef", "Das Riff", "Le récif"},
    {"The reef by night", "Das Riff bei Nacht", "Le récif la nuit"},
    {"The kelp forest", "Der Kelpwald", "La forêt de kelp"},
});

// Returns the index of a text's row; kTexts.size() if it has none.
constexpr size_t findText(std::string_view english) {
    size_t row = 0;
    while (row < kTexts.size() && english != kTexts[row][0]) ++row;
    return row;
}

// A text that has a row in kTexts, made from its English words.
class Text {
  public:
    consteval Text(const char* english) : row_(findText(english)) { (void)kTexts.at(row_); }
    constexpr const char* in(Language language) const { return kTexts[row_][static_cast<size_t>(language)]; }
    // The same with values in place of its "{}".
    template <class... Values> std::string in(Language language, const Values&... values) const {
        return fmt::format(fmt::runtime(in(language)), values...);
    }
    constexpr bool operator==(const Text&) const = default;

  private:
    size_t row_;
};

// One message to the player: a text, and the value that replaces its "{}". All messages are of this type.
struct Notice {
    Text text;
    std::string value{}; // a name, a number or a file, in place of "{}"

    std::string in(Language language) const { return text.in(language, value); }
    bool operator==(const Notice&) const = default;
};

// Translates a name from a file or table; one without a row stays as it is.
inline std::string_view translated(std::string_view english, Language language) {
    const size_t row = findText(english);
    return row < kTexts.size() ? kTexts[row][static_cast<size_t>(language)] : english;
}

// Returns the language of a locale such as "de_AT.UTF-8" in LC_ALL; English if the game does not have it.
constexpr Language languageOf(std::string_view locale) {
    if (locale.starts_with("de")) return Language::German;
    if (locale.starts_with("fr")) return Language::French;
    return Language::English;
}

} // namespace shoal::game
